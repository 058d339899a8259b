#include "render/solids/tiled_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/casters_impl.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kTile = 8;  // receivers a side

}  // namespace

std::vector<TriangleMesh> casting_meshes(const Casters& casters) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : casters.objects())
    if (object.casts && !object.mesh.empty()) meshes.push_back(object.mesh);
  return meshes;
}

std::vector<float> seen_from(const Casters& casters, const LightShape& light, std::span<const Vec3> points,
                             const Progress& progress) {
  if (points.empty()) return {};
  // A picture eight rows high, a tile beside the other; the last is filled up with the last point.
  const std::size_t tiles = (points.size() + kTile * kTile - 1) / (kTile * kTile), width = kTile * tiles;
  const auto place = [&](std::size_t i) {
    const std::size_t tile = i / (kTile * kTile), at = i % (kTile * kTile);
    return at / kTile * width + tile * kTile + at % kTile;
  };
  std::vector<Vec3> pixels(kTile * width, points.back());
  const auto for_each_point = [&](const auto& visit) {
    casters.impl().threads->execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) visit(i);
      });
    });
  };
  for_each_point([&](std::size_t i) { pixels[place(i)] = points[i]; });
  VisibilityOptions options{.progress = progress};
  options.options["silhouette-tolerance"] = 0.0;
  const Receivers receivers{
      .points = pixels, .width = static_cast<int>(width), .height = static_cast<int>(kTile)};
  const std::vector<float> seen = visibility(casters, light, receivers, options).visibility;
  std::vector<float> out(points.size());
  for_each_point([&](std::size_t i) { out[i] = seen[place(i)]; });
  return out;
}

}  // namespace penumbra::detail
