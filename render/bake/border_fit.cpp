#include "render/bake/border_fit.h"

#include <algorithm>
#include <cmath>

namespace penumbra::detail {
namespace {

/// Accuracy. How much the values that are there count, of the weight of a texel full of samples: what samples
/// leave open stays; what they say changes by about as little as this.
constexpr double kStay = 1e-4;
/// Accuracy: the residual that is left, of the first one.
constexpr double kResidual = 1e-5;
constexpr int kMostSteps = 500;

/// Rows of the least squares: of each sample the unknown texels that it needs, and what is left for them.
class System {
 public:
  System(int width, int height, const std::vector<BorderSample>& samples, const std::vector<float>& values,
         const std::vector<std::uint32_t>& unknown, const std::vector<float>& channel)
      : size_(unknown.size()), start_(unknown.size()) {
    std::vector<std::int32_t> number(channel.size(), -1);
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      number[unknown[i]] = static_cast<std::int32_t>(i);
      start_[i] = channel[unknown[i]];
    }
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const BilinearTexels texels = bilinear_texels(width, height, samples[s].at);
      Row row{.weight = samples[s].weight, .rest = values[s]};
      bool is_needed = false;
      for (std::size_t k = 0; k < 4; ++k) {
        row.index[k] = number[texels.index[k]];
        row.part[k] = texels.weight[k];
        row.rest -= texels.weight[k] * channel[texels.index[k]];  // of the values that are there
        is_needed = is_needed || (row.index[k] >= 0 && texels.weight[k] > 0.0);
      }
      if (is_needed) rows_.push_back(row);
    }
  }

  /// The change of the unknown texels, by the method of conjugate gradients (Hestenes and Stiefel, 1952).
  std::vector<double> solve() const {
    std::vector<double> x(size_, 0.0), r(size_, 0.0);
    for (const Row& row : rows_) row.scatter(row.weight * row.rest, r);
    std::vector<double> p = r;
    const double first = dot(r, r);
    double now = first;
    for (int step = 0; step < kMostSteps && now > kResidual * kResidual * first; ++step) {
      const std::vector<double> ap = apply(p);
      const double along = now / dot(p, ap);
      for (std::size_t i = 0; i < size_; ++i) x[i] += along * p[i], r[i] -= along * ap[i];
      const double next = dot(r, r);
      for (std::size_t i = 0; i < size_; ++i) p[i] = r[i] + next / now * p[i];
      now = next;
    }
    return x;
  }
  double start(std::size_t i) const { return start_[i]; }

 private:
  struct Row {
    double weight = 0.0, rest = 0.0;
    std::array<std::int32_t, 4> index{};
    std::array<double, 4> part{};

    void scatter(double value, std::vector<double>& out) const {
      for (std::size_t k = 0; k < 4; ++k)
        if (index[k] >= 0) out[static_cast<std::size_t>(index[k])] += part[k] * value;
    }
    double collect(const std::vector<double>& in) const {
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k)
        if (index[k] >= 0) sum += part[k] * in[static_cast<std::size_t>(index[k])];
      return sum;
    }
  };

  static double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }
  std::vector<double> apply(const std::vector<double>& x) const {
    std::vector<double> out(size_);
    for (std::size_t i = 0; i < size_; ++i) out[i] = kStay * x[i];
    for (const Row& row : rows_) row.scatter(row.weight * row.collect(x), out);
    return out;
  }

  std::size_t size_;
  std::vector<double> start_;
  std::vector<Row> rows_;
};

}  // namespace

BilinearTexels bilinear_texels(int width, int height, const glm::dvec2& at) {
  const double x = std::clamp(at.x - 0.5, 0.0, width - 1.0), y = std::clamp(at.y - 0.5, 0.0, height - 1.0);
  const int i = std::min(static_cast<int>(x), std::max(0, width - 2)),
            j = std::min(static_cast<int>(y), std::max(0, height - 2));
  const double u = x - i, v = y - j;
  const auto index = [&](int a, int b) {
    return static_cast<std::size_t>(std::min(b, height - 1)) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(std::min(a, width - 1));
  };
  return {{index(i, j), index(i + 1, j), index(i, j + 1), index(i + 1, j + 1)},
          {(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v}};
}

void fit_borders(int width, int height, const std::vector<BorderSample>& samples,
                 const std::vector<float>& values, const std::vector<std::uint32_t>& unknown,
                 std::vector<float>& channel) {
  const System system(width, height, samples, values, unknown, channel);
  const std::vector<double> change = system.solve();
  for (std::size_t i = 0; i < unknown.size(); ++i)
    channel[unknown[i]] = static_cast<float>(system.start(i) + change[i]);
}

void dilate(int width, int height, int rounds, std::vector<char> has_value,
            std::vector<std::vector<float>>& channels) {
  const auto index = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::size_t> grown;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (has_value[index(x, y)]) continue;
        std::vector<std::size_t> from;
        for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
          for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i)
            if (has_value[index(i, j)]) from.push_back(index(i, j));
        if (from.empty()) continue;
        grown.push_back(index(x, y));
        for (std::vector<float>& channel : channels) {
          double sum = 0.0;
          for (const std::size_t i : from) sum += channel[i];
          channel[index(x, y)] = static_cast<float>(sum / static_cast<double>(from.size()));
        }
      }
    for (const std::size_t i : grown) has_value[i] = 1;
  }
}

}  // namespace penumbra::detail
