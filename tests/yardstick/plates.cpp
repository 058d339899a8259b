#include <array>
#include <cmath>
#include <numbers>

#include "apps/cli/compare/judge.h"
#include "tests/yardstick/closed_form.h"
#include "tests/yardstick/judging.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

constexpr PictureSize kSize{320, 240};
constexpr int kRays = 4'096;
// Between a certificate and the closed form, which rounds.
constexpr double kRounding = 1e-9;

/// A square of side 1.2, turned and tilted, above the origin.
std::array<Vec3, 4> plate_corners() {
  const double turn = 0.35, tilt = 0.2;
  std::array<Vec3, 4> out;
  for (std::size_t i = 0; i < 4; ++i) {
    const double s = i == 0 || i == 3 ? -0.6 : 0.6, t = i < 2 ? -0.6 : 0.6;
    const double along = s * std::cos(turn) - t * std::sin(turn),
                 across = s * std::sin(turn) + t * std::cos(turn);
    out[i] = {along * std::cos(tilt), 1.0 + along * std::sin(tilt), across};
  }
  return out;
}

TriangleMesh square(const std::array<Vec3, 4>& corners) {
  const IndexedTriangle faces[] = {{0, 2, 1}, {0, 3, 2}};
  return TriangleMesh::build(corners, faces);
}

struct Ground {
  std::string name;
  double half;
  bool casts;
};
std::vector<Ground> grounds() {
  std::vector<Ground> out;
  for (const double half : {20.0, 200.0, 2'000.0, 20'000.0, 1e6})
    for (const bool casts : {false, true})
      out.push_back({text("floor_%g%s", half, casts ? "_casts" : ""), half, casts});
  return out;
}

template <class Shape>
Scene plate_scene(const Ground& ground, const Shape& light) {
  Scene scene;
  scene.lights.push_back({.shape = light});
  scene.camera = {{0.5, 3.0, 3.5}, {-0.2, 0.0, -0.1}, {0, 1, 0}, 50};
  const double h = ground.half;
  scene.objects.push_back({"floor", square({Vec3(-h, 0, -h), Vec3(h, 0, -h), Vec3(h, 0, h), Vec3(-h, 0, h)}),
                           Vec3(0.8), ground.casts});
  scene.objects.push_back({"plate", square(plate_corners()), Vec3(0.8), true});
  return scene;
}

/// The visible share of the light at points of the floor, which lies wholly below the light.
struct Truth {
  std::vector<std::uint32_t> pixels;
  std::vector<double> visible;
};
template <class Shape>
Truth truth_of(const Scene& scene, const Shape& light) {
  const SurfaceBuffer surface = apps::surface_by_oracle(scene, kSize.width, kSize.height);
  const auto corners = plate_corners();
  Truth out;
  for (std::uint32_t i = 0; i < surface.size(); ++i) {
    if (surface.object[i] != 0) continue;
    const std::vector<Point> plate = seen_on_light(light, surface.position[i], corners);
    out.pixels.push_back(i);
    out.visible.push_back(1.0 - std::abs(area_in_unit_disk(plate)) / std::numbers::pi);
  }
  return out;
}

struct PlateFigures {
  std::size_t penumbra = 0, elsewhere = 0, wrong_certificates = 0;
  double rmse = 0.0, most = 0.0;
};
PlateFigures figures_of(const RenderResult& picture, const Truth& truth) {
  const MethodFrame& frame = picture.lights.front();
  PlateFigures out;
  double squares = 0.0;
  for (std::size_t k = 0; k < truth.pixels.size(); ++k) {
    const std::uint32_t i = truth.pixels[k];
    const double v = truth.visible[k], difference = frame.visibility[i] - v;
    if (picture.surface.object[i] != 0) {
      ++out.elsewhere;
      continue;
    }
    out.most = std::max(out.most, std::abs(difference));
    if (!frame.region.empty())
      out.wrong_certificates +=
          (frame.region[i] == 0 && v < 1.0 - kRounding) || (frame.region[i] == 2 && v > kRounding);
    if (v <= kRounding || v >= 1.0 - kRounding) continue;
    squares += difference * difference;
    ++out.penumbra;
  }
  out.rmse = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(out.penumbra, 1)));
  return out;
}

/// Noise of two pictures with seeds of their own, and what is left of their error without it.
struct Noise {
  double noise = 0.0, bias = 0.0;
};
Noise noise_of(const RenderResult& first, const RenderResult& second, const Truth& truth) {
  double noise = 0.0, bias = 0.0, count = 0.0;
  for (std::size_t k = 0; k < truth.pixels.size(); ++k) {
    const std::uint32_t i = truth.pixels[k];
    const double v = truth.visible[k];
    if (v <= kRounding || v >= 1.0 - kRounding) continue;
    const double a = first.lights.front().visibility[i] - v, b = second.lights.front().visibility[i] - v;
    noise += 0.5 * (a - b) * (a - b);
    bias += a * b;
    ++count;
  }
  return {std::sqrt(noise / count), std::sqrt(std::max(0.0, bias / count))};
}

void judge_silhouette(Report& report, const std::string& line, JudgedScene& scene, const Truth& truth) {
  const PlateFigures f = figures_of(scene.draw({.method = "silhouette", .size = kSize}), truth);
  const bool right = f.penumbra > 1000 && f.rmse <= 5e-4 && f.most <= 0.005 && f.wrong_certificates == 0 &&
                     1000 * f.elsewhere <= truth.pixels.size();
  report.add(line, right,
             text("%5zu in penumbra, RMSE %.6f, at most %.6f; certificates wrong %zu; other faces at %zu",
                  f.penumbra, f.rmse, f.most, f.wrong_certificates, f.elsewhere));
}

void judge_reference(Report& report, const std::string& line, JudgedScene& scene, const Truth& truth) {
  const auto draw = [&](std::uint64_t seed) {
    return scene.draw({.method = "reference",
                       .options = {{"samples", std::uint64_t{kRays}}, {"seed", seed}},
                       .size = kSize});
  };
  const RenderResult first = draw(1), second = draw(2);
  const PlateFigures f = figures_of(first, truth);
  const Noise noise = noise_of(first, second, truth);
  // Its usual noise at 4,096 rays is .0008; the bias of some thousand pixels is known to a tenth of it.
  report.add(line, f.penumbra > 1000 && noise.noise <= 0.0012 && noise.bias <= 3e-4 && f.most <= 0.02,
             text("%5zu in penumbra, RMSE %.6f, noise %.6f, without noise %.6f, at most %.6f", f.penumbra,
                  f.rmse, noise.noise, noise.bias, f.most));
}

template <class Shape>
void judge_plates_under(Report& report, const std::string& kind, const Shape& light) {
  for (const Ground& ground : grounds()) {
    const std::string line = "plates/" + kind + "_" + ground.name;
    if (!report.wants(line)) continue;
    const Scene scene = plate_scene(ground, light);
    const Truth truth = truth_of(scene, light);
    JudgedScene judged(scene);
    const auto judge = [&](const std::string& method, const auto& by) {
      const std::string name = line + "/" + method;
      if (report.wants(name) && judged.takes(contender(method)))
        report.attempt(name, [&] { by(report, name, judged, truth); });
    };
    judge("silhouette", judge_silhouette);
    judge("reference", judge_reference);
  }
}

}  // namespace

void judge_plates(Report& report) {
  if (!report.wants("plates")) return;
  judge_plates_under(report, "disk", DiskLight{{0.8, 5.0, 0.5}, {-0.1, -1.0, -0.05}, 0.5});
  judge_plates_under(report, "distant", DistantLight{{-0.2, -1.0, -0.1}, 11.0});
}

}  // namespace penumbra::yardstick
