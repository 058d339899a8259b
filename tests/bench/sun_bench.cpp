// A year of hourly suns on 10,000 receivers of a city block: exact areas against 64 rays a receiver, time by
// time in turns.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "penumbra/render/sun/sun_exposure.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kReceivers = 10'000;
constexpr double kNewYear = 1767225600.0;  // 2026-01-01T00:00Z
constexpr int kHours = 8760;

struct OnFaces {
  std::vector<Vec3> points, normals;
  std::vector<std::int32_t> objects;
  std::vector<std::uint32_t> faces;
};

/// Spread over all objects, as many on a face as its share of the area is, by Roberts' sequence.
OnFaces receivers_on_all(const Scene& scene) {
  const auto cross = [&](std::size_t o, const IndexedTriangle& t) {
    const auto p = scene.objects[o].mesh.positions();
    return glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
  };
  double area = 0.0;
  for (std::size_t o = 0; o < scene.objects.size(); ++o)
    for (const IndexedTriangle& t : scene.objects[o].mesh.triangles()) area += glm::length(cross(o, t));
  OnFaces out;
  double before = 0.0;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const auto p = scene.objects[o].mesh.positions();
    for (std::uint32_t f = 0; f < scene.objects[o].mesh.triangles().size(); ++f) {
      const IndexedTriangle& t = scene.objects[o].mesh.triangles()[f];
      const Vec3 n = cross(o, t);
      before += glm::length(n);
      while (static_cast<double>(out.points.size()) + 0.5 < before / area * kReceivers) {
        const auto k = static_cast<double>(out.points.size());
        double u = std::fmod(0.5 + k * 0.7548776662466927, 1.0),
               v = std::fmod(0.5 + k * 0.5698402909980532, 1.0);
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        out.points.push_back(p[t[0]] + u * (p[t[1]] - p[t[0]]) + v * (p[t[2]] - p[t[0]]));
        out.normals.push_back(glm::normalize(n));
        out.objects.push_back(static_cast<std::int32_t>(o));
        out.faces.push_back(f);
      }
    }
  }
  return out;
}

}  // namespace

void bench_sun(Record& record, const SceneNames&) {
  const Scene scene = load_scene(std::string(PENUMBRA_DATA) + "/sun/city-block.json").scene;
  const OnFaces on = receivers_on_all(scene);
  const Receivers receivers{
      .points = on.points, .normals = on.normals, .objects = on.objects, .faces = on.faces};
  const Casters casters(scene.objects);
  const SunSky berlin{{.latitude = 52.5, .longitude = 13.4}, {}};
  SunExposure areas(casters, receivers, berlin);
  SunExposure rays(casters, receivers, berlin,
                   {.method = "reference", .options = {{"samples", std::uint64_t{64}}}});
  double square = 0.0;
  std::size_t partly = 0;
  StageClock clock;
  for (int hour = 0; hour < kHours; ++hour) {
    const double time = kNewYear + 3600.0 * hour;
    const std::vector<float> exact = areas.seen(time);
    clock.finish("areas");
    const std::vector<float> sampled = rays.seen(time);
    clock.finish("rays");
    for (std::size_t i = 0; i < exact.size(); ++i)
      if (exact[i] > 0.0f && exact[i] < 1.0f) {
        square += std::pow(double{sampled[i]} - exact[i], 2);
        ++partly;
      }
    clock.restart();
  }
  const double of_areas = clock.stages()[0].milliseconds, of_rays = clock.stages()[1].milliseconds;
  const double days = kHours - static_cast<double>(areas.counts().nights);
  const double rmse = std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, partly)));
  std::printf("sun: %zu receivers, %d hours, %.0f of them by day\n", receivers.size(), kHours, days);
  std::printf("  exact areas  %8.1f s  %6.2f ms a sun\n", of_areas / 1000.0, of_areas / days);
  std::printf(
      "  64 rays      %8.1f s  %6.2f ms a sun  %.1f times as long, RMSE %.4f where the sun is seen in part "
      "(%zu)\n",
      of_rays / 1000.0, of_rays / days, of_rays / of_areas, rmse, partly);
  record.add("city-block/receivers", "receivers", static_cast<double>(receivers.size()));
  record.add("city-block/suns", "suns", days);
  record.add("city-block/areas", "ms", of_areas);
  record.add("city-block/rays64", "ms", of_rays);
  record.add("city-block/rays64-rmse", "visibility", rmse);
}

}  // namespace penumbra::bench
