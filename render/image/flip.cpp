#include "render/image/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

namespace penumbra {
namespace {

using Color = std::array<double, 3>;
using Matrix = std::array<Color, 3>;

// Section 4: exponents and the split of the range.
constexpr double kColorExponent = 0.7, kPart = 0.4, kPartTo = 0.95;
constexpr double kFeatureExponent = 0.5, kFeatureWidth = 0.082;  // degrees

// sRGB's primaries (IEC 61966-2-1) to CIE XYZ, as fractions of whole numbers that are exact.
constexpr Matrix kToXyz{{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                         {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                         {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

constexpr Color times(const Matrix& m, const Color& v) {
  Color out{};
  for (std::size_t r = 0; r < 3; ++r) out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return out;
}

constexpr Matrix inverse(const Matrix& m) {
  Matrix out{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      out[c][r] = m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] -
                  m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3];
  const double det = m[0][0] * out[0][0] + m[0][1] * out[1][0] + m[0][2] * out[2][0];
  for (Color& row : out)
    for (double& value : row) value /= det;
  return out;
}

constexpr Matrix kToRgb = inverse(kToXyz);
constexpr Color kWhite = times(kToXyz, {1.0, 1.0, 1.0});

/// XYZ over white, a piece linear instead of a root near 0.
Color relative(const Color& xyz) {
  return {xyz[0] / kWhite[0], xyz[1] / kWhite[1], xyz[2] / kWhite[2]};
}

/// Linearized CIELab (Y, Cx, Cz): the space in which the eye's blur is a convolution.
Color to_opponent(const Color& rgb) {
  const Color n = relative(times(kToXyz, rgb));
  return {116.0 * n[1] - 16.0, 500.0 * (n[0] - n[1]), 200.0 * (n[1] - n[2])};
}

Color from_opponent(const Color& c) {
  const double y = (c[0] + 16.0) / 116.0, x = y + c[1] / 500.0, z = y - c[2] / 200.0;
  Color rgb = times(kToRgb, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
  for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
  return rgb;
}

/// CIELab with a and b weakened in the dark (Hunt effect).
Color to_hunt_lab(const Color& rgb) {
  constexpr double kDelta = 6.0 / 29.0;
  Color f = relative(times(kToXyz, rgb));
  for (double& v : f)
    v = v > kDelta * kDelta * kDelta ? std::cbrt(v) : v / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
  const double lightness = 116.0 * f[1] - 16.0, hunt = 0.01 * lightness;
  return {lightness, hunt * 500.0 * (f[0] - f[1]), hunt * 200.0 * (f[1] - f[2])};
}

double hyab(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// The largest distance is that of green and blue. Small ones get most of the range.
double color_error(const Color& a, const Color& b) {
  static const double kMost =
      std::pow(hyab(to_hunt_lab({0.0, 1.0, 0.0}), to_hunt_lab({0.0, 0.0, 1.0})), kColorExponent);
  const double error = std::pow(hyab(a, b), kColorExponent), part = kPart * kMost;
  if (error < part) return kPartTo / part * error;
  return kPartTo + (error - part) / (kMost - part) * (1.0 - kPartTo);
}

/// Weights of the pixels -radius to radius.
using Kernel = std::vector<double>;

Kernel sampled(int radius, const std::function<double(double)>& f) {
  Kernel out;
  for (int i = -radius; i <= radius; ++i) out.push_back(f(i));
  return out;
}

double sum_of(const Kernel& kernel) {
  double sum = 0.0;
  for (const double v : kernel) sum += v;
  return sum;
}

/// A channel of a picture.
struct Plane {
  int width, height;
  std::vector<double> values;

  /// What is beyond the border is as the border.
  double at(int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

Plane filtered(const Plane& in, const Kernel& along_x, const Kernel& along_y) {
  const auto pass = [](const Plane& from, const Kernel& kernel, int dx, int dy) {
    Plane out{from.width, from.height, std::vector<double>(from.values.size())};
    const int radius = static_cast<int>(kernel.size() / 2);
    tbb::parallel_for(0, from.height, [&](int y) {
      std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(from.width);
      for (int x = 0; x < from.width; ++x, ++i)
        for (int k = -radius; k <= radius; ++k)
          out.values[i] += kernel[static_cast<std::size_t>(k + radius)] * from.at(x + k * dx, y + k * dy);
    });
    return out;
  };
  return pass(pass(in, along_x, 1, 0), along_y, 0, 1);
}

/// A Gaussian of the contrast sensitivity, a √(π/b) exp(-π² z²/b) at z degrees: table 1.
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kLightness[] = {{1.0, 0.0047}}, kRedGreen[] = {{1.0, 0.0053}},
                      kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidest = 0.04;

/// The channel as the eye sees it: a sum of Gaussians, each separable, of total weight 1.
Plane blurred(const Plane& in, std::span<const Sensitivity> parts, double pixels_per_degree) {
  constexpr double kPi = std::numbers::pi;
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixels_per_degree));
  Plane out{in.width, in.height, std::vector<double>(in.values.size())};
  double total = 0.0;
  for (const Sensitivity& part : parts) {
    const Kernel kernel = sampled(radius, [&](double x) {
      const double z = x / pixels_per_degree;
      return std::exp(-kPi * kPi * z * z / part.b);
    });
    const double scale = part.a * std::sqrt(kPi / part.b), sum = sum_of(kernel);
    total += scale * sum * sum;
    const Plane one = filtered(in, kernel, kernel);
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += scale * one.values[i];
  }
  for (double& v : out.values) v /= total;
  return out;
}

/// Positive weights sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
  double above = 0.0, below = 0.0;
  for (const double v : kernel) (v > 0.0 ? above : below) += std::abs(v);
  for (double& v : kernel) v /= v > 0.0 ? above : below;
  return kernel;
}

/// Lengths of first derivatives (edges) and of second ones (points).
struct Features {
  std::vector<double> edges, points;
};

Features features_of(const Plane& opponent, double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const auto gauss = [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
  Kernel smooth = sampled(radius, gauss);
  const double sum = sum_of(smooth);
  for (double& v : smooth) v /= sum;
  const Kernel first = balanced(sampled(radius, [&](double x) { return -x * gauss(x); }));
  const Kernel second =
      balanced(sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * gauss(x); }));
  Plane lightness = opponent;
  for (double& v : lightness.values) v = (v + 16.0) / 116.0;
  const auto lengths = [&](const Kernel& kernel) {
    const Plane x = filtered(lightness, kernel, smooth), y = filtered(lightness, smooth, kernel);
    std::vector<double> out;
    for (std::size_t i = 0; i < x.values.size(); ++i) out.push_back(std::hypot(x.values[i], y.values[i]));
    return out;
  };
  return {lengths(first), lengths(second)};
}

/// A picture as colors that a person sees, and its features.
struct Seen {
  std::vector<Color> lab;
  Features features;
};

Seen see(int width, int height, std::span<const float> linear, double pixels_per_degree) {
  const std::size_t pixels = linear.size() / 3;
  std::array<Plane, 3> planes;
  planes.fill({width, height, std::vector<double>(pixels)});
  for (std::size_t i = 0; i < pixels; ++i) {
    Color rgb;
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::clamp(static_cast<double>(linear[3 * i + c]), 0.0, 1.0);
    const Color opponent = to_opponent(rgb);
    for (std::size_t c = 0; c < 3; ++c) planes[c].values[i] = opponent[c];
  }
  Seen out{std::vector<Color>(pixels), features_of(planes[0], pixels_per_degree)};
  const std::array<Plane, 3> soft{blurred(planes[0], kLightness, pixels_per_degree),
                                  blurred(planes[1], kRedGreen, pixels_per_degree),
                                  blurred(planes[2], kBlueYellow, pixels_per_degree)};
  for (std::size_t i = 0; i < pixels; ++i)
    out.lab[i] = to_hunt_lab(from_opponent({soft[0].values[i], soft[1].values[i], soft[2].values[i]}));
  return out;
}

}  // namespace

std::vector<float> flip_map(int width, int height, std::span<const float> reference,
                            std::span<const float> test, const FlipOptions& options) {
  assert(reference.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  assert(reference.size() == test.size());
  const Seen a = see(width, height, reference, options.pixels_per_degree);
  const Seen b = see(width, height, test, options.pixels_per_degree);
  std::vector<float> out(a.lab.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double color = color_error(a.lab[i], b.lab[i]);
    const double feature = std::max(std::abs(a.features.edges[i] - b.features.edges[i]),
                                    std::abs(a.features.points[i] - b.features.points[i]));
    const double sharpened = std::clamp(std::pow(feature / std::numbers::sqrt2, kFeatureExponent), 0.0, 1.0);
    out[i] = static_cast<float>(std::pow(color, 1.0 - sharpened));
  }
  return out;
}

}  // namespace penumbra
