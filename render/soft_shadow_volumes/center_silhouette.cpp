#include "render/soft_shadow_volumes/center_silhouette.h"

#include <algorithm>

#include "render/silhouette/collect/lit_scene.h"
#include "render/soft_shadow_volumes/layers.h"

namespace penumbra::detail {
namespace {

/// Accuracy. A mesh of which a smaller share of the edges is boundary is a solid with holes.
constexpr double kFewBoundaryEdges = 0.05;

bool is_solid(const TriangleMesh& mesh) {
  if (mesh.is_closed()) return true;
  const auto edges = mesh.edges();
  const auto boundary = std::ranges::count_if(edges, [](const Edge& e) { return e.is_boundary(); });
  return static_cast<double>(boundary) < kFewBoundaryEdges * static_cast<double>(edges.size());
}

bool is_within(const Bounds& box, const Vec3& p) {
  return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y && box.low.z <= p.z &&
         p.z <= box.high.z;
}

}  // namespace

std::vector<double> layers_of_faces(const Scene& scene, const RayScene& rays, const CircularLight& light) {
  std::vector<double> layers;
  std::vector<char> around;
  for (const SceneObject& object : scene.objects) {
    layers.push_back(object.casts && is_solid(object.mesh) ? 0.5 : 1.0);
    around.push_back(object.casts && !light.is_distant() && is_within(object.mesh.bounds(), light.center));
  }
  if (std::ranges::none_of(around, [](char flag) { return flag != 0; })) return layers;
  // Along any line from the center a solid around it is left once more than it is entered.
  const std::vector<std::size_t> met = faces_met(
      {.from = {.point = light.center, .object = -1, .face = 0}, .way = {0.31, 0.83, -0.46}, .endless = true},
      rays, scene.objects.size());
  for (std::size_t i = 0; i < layers.size(); ++i)
    if (around[i] && met[i] % 2 == 1) layers[i] = 1.0;
  return layers;
}

LayeredBand make_layered_band(const Scene& scene, const UnitLight& unit, const SceneEdges& edges,
                              const Bounds& asked_about, const std::vector<char>& cannot_occlude,
                              const std::vector<double>& layers) {
  const auto band_with = [&](double wanted) {
    std::vector<char> left_out(layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i)
      left_out[i] = layers[i] != wanted || (!cannot_occlude.empty() && cannot_occlude[i] != 0);
    return make_band(LitScene(scene, unit, edges, asked_about, left_out), edges);
  };
  const Band halves = band_with(0.5), wholes = band_with(1.0);
  LayeredBand out;
  out.band.edges = LargeArray<BandEdge>(halves.edges.size() + wholes.edges.size());
  std::copy_n(halves.edges.data(), halves.edges.size(), out.band.edges.data());
  std::copy_n(wholes.edges.data(), wholes.edges.size(), out.band.edges.data() + halves.edges.size());
  out.layers.assign(halves.edges.size(), 0.5);
  out.layers.resize(out.band.edges.size(), 1.0);
  for (const Band* band : {&halves, &wholes}) {
    out.band.casters.insert(out.band.casters.end(), band->casters.begin(), band->casters.end());
    out.band.faces += band->faces;
    out.band.mesh_edges += band->mesh_edges;
    out.band.cut_edges += band->cut_edges;
  }
  out.band.extent = halves.extent;
  out.band.depth = halves.depth;
  return out;
}

CenterSilhouette::CenterSilhouette(const LayeredBand& from, const glm::dvec2& point) {
  const Band& all = from.band;
  // Seen from behind the casters, a face is turned the other way than from the light.
  const Vec3 eye(point, 0.0);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.edges.size(); ++i) {
    const int jump = jump_at(all.edges[i], eye, all.extent);
    if (jump == 0) continue;
    kept.push_back(i);
    steps.push_back(-from.layers[i] * jump);
  }
  band.edges = LargeArray<BandEdge>(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    band.edges[i] = all.edges[kept[i]];
    band.edges[i].right = kNoFace;
  }
  band.casters = all.casters;
  band.extent = all.extent;
  band.depth = all.depth;
}

}  // namespace penumbra::detail
