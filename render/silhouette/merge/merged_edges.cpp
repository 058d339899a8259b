#include "render/silhouette/merge/merged_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <span>

#include "mesh/vectors.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/silhouette/merge/caster_merger.h"
#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

// Speed. Seen in the benchmark `growth`.
/// The tolerance of the finest level, in the frame of all objects. Each level doubles it.
constexpr double kFinest = 0x1p-22;
constexpr int kMostLevels = 16;
/// The most patches and single faces of the finest level, over the number of faces. At its tolerance only
/// flat patches merge, which costs no accuracy.
constexpr double kWorthFlat = 0.3;
/// The same of the next level that is made, if the finest is not.
constexpr double kWorthWhile = 0.04;
/// The most patches and single faces of another level, over those of the level before.
constexpr double kWorthAnother = 0.75;
/// Blocks that a task bounds.
constexpr std::size_t kBlocksPerTask = 256;

constexpr std::size_t kLanes = kFloatLanes;

/// One an object; none for objects that do not cast.
using Mergers = std::vector<std::optional<CasterMerger>>;

/// The frame of rays, as MergedLevel::block takes it.
struct RayUnits {
  Vec3 origin;
  double scale;
  Vec3 point(const Vec3& p) const { return (p - origin) * scale; }
  Vec3 direction(const Vec3& d) const { return d; }
  double per_unit() const { return scale; }
};

/// An edge and its middle.
struct PlacedEdge {
  std::array<float, 3> at;
  MergedEdge edge;
};

/// In float, no less than it is.
float rounded_up(double x) {
  return static_cast<float>((1.0 + 0x1p-20) * x);
}

/// The edges of all casters, in an order in which neighbors lie close together.
std::vector<MergedEdge> neighbors_together(const Scene& scene, const Mergers& mergers) {
  std::vector<PlacedEdge> placed;
  for (std::uint32_t object = 0; object < mergers.size(); ++object) {
    if (!mergers[object]) continue;
    const TriangleMesh& mesh = scene.objects[object].mesh;
    const CasterMerger& caster = *mergers[object];
    for (const EdgeChain& c : caster.chains()) {
      const VertexId from{c.from}, to{c.to};
      const Vec3 middle = 0.5 * mesh.position(from) + 0.5 * mesh.position(to);
      placed.push_back(
          {{static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)},
           {object, from, to, c.left, c.right, rounded_up(caster.deviation(c)),
            rounded_up(1.0001 * caster.margin(c)), rounded_up(c.stray), rounded_up(caster.swept(c)),
            rounded_up(caster.swept_at_any(c))}});
    }
  }
  order_by_place(placed.data(), placed.data() + placed.size(), kLanes);
  std::vector<MergedEdge> out;
  out.reserve(placed.size());
  for (const PlacedEdge& p : placed) out.push_back(p.edge);
  return out;
}

/// The level of detail at which the casters are.
MergedLevel make_level(const Scene& scene, const Mergers& mergers, const RayUnits& units) {
  MergedLevel level;
  level.patches.resize(scene.objects.size());
  for (const SceneObject& o : scene.objects)
    level.faces.push_back(static_cast<std::uint32_t>(o.mesh.triangles().size()));
  for (std::uint32_t object = 0; object < mergers.size(); ++object) {
    if (mergers[object]) level.patches[object] = mergers[object]->patches();
  }
  level.edges = neighbors_together(scene, mergers);
  double sum = 0.0, count = 0.0;
  for (const MergedEdge& e : level.edges) {
    sum += e.deviation;
    count += e.deviation > 0.0f ? 1.0 : 0.0;
  }
  level.deviation = sum / std::max(1.0, count);
  std::vector<std::uint32_t> all(level.block_count());
  std::iota(all.begin(), all.end(), 0u);
  const MergedLevel::EdgeCounts counts = level.count_edges(all);
  std::vector<BlockBounds> bounds(level.block_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bounds.size(), kBlocksPerTask),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        bounds[i] = level.block(scene, i, units, 1.0, counts).bounds();
                    });
  level.tree = BoundsTree(std::move(bounds), 1.0);
  return level;
}

}  // namespace

MergedLevel::EdgeCounts MergedLevel::count_edges(std::span<const std::uint32_t> blocks) const {
  EdgeCounts out(patches.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i].resize(patches[i].size());
  const auto count = [&](const MergedEdge& e, std::uint32_t side) {
    if (side != MergedEdge::kNoSide && side >= faces[e.object]) ++out[e.object][side - faces[e.object]];
  };
  for (const std::uint32_t block : blocks) {
    const std::size_t first = block * MergedBlock::kEdges;
    for (std::size_t i = first; i < std::min(first + MergedBlock::kEdges, edges.size()); ++i)
      count(edges[i], edges[i].left), count(edges[i], edges[i].right);
  }
  return out;
}

std::size_t MergedLevel::bytes() const {
  std::size_t sum = edges.size() * sizeof(MergedEdge) + tree.bytes();
  for (const auto& p : patches) sum += p.size() * sizeof(FacePatch);
  return sum;
}

MergedEdges::MergedEdges(const Scene& scene, const Vec3& origin, double scale)
    : origin_(origin), scale_(scale) {
  const auto is_large = [](const SceneObject& o) {
    return o.casts && o.mesh.triangles().size() >= CasterMerger::kFewestFaces;
  };
  if (std::ranges::none_of(scene.objects, is_large)) return;

  // Patches of all casters, for any tolerance.
  Mergers mergers(scene.objects.size());
  tbb::parallel_for(std::size_t{0}, mergers.size(), [&](std::size_t i) {
    if (scene.objects[i].casts) mergers[i].emplace(scene.objects[i].mesh);
  });
  const auto count_parts = [&](double tolerance) {
    std::size_t sum = 0;
    for (const auto& m : mergers) sum += m ? m->count_parts(tolerance) : 0;
    return static_cast<double>(sum);
  };

  // One level a tolerance, as long as it leaves much fewer parts.
  double faces = 0.0;
  for (const SceneObject& o : scene.objects)
    faces += o.casts ? static_cast<double>(o.mesh.triangles().size()) : 0.0;
  double most_parts = kWorthWhile * faces;
  for (int i = 0; i < kMostLevels; ++i) {
    const double tolerance = std::ldexp(kFinest, i) / scale, parts = count_parts(tolerance);
    if (parts > (i == 0 ? kWorthFlat * faces : most_parts)) continue;
    most_parts = kWorthAnother * parts;
    tbb::parallel_for(std::size_t{0}, mergers.size(), [&](std::size_t k) {
      if (mergers[k]) mergers[k]->merge(tolerance);
    });
    levels_.push_back(make_level(scene, mergers, {origin, scale}));
  }
}

std::vector<std::uint32_t> MergedEdges::blocks_of(const MergedLevel& level, const CircularLight& light,
                                                  std::span<const char> cannot_occlude) const {
  std::vector<NodeMask> parents;
  const FloatDisk disk(light, origin_, scale_);
  level.tree.collect(SidesTest(disk.box, disk.weight), parents);
  std::vector<std::uint32_t> out;
  const auto casts = [&](std::size_t block) {
    const std::size_t first = block * MergedBlock::kEdges;
    const std::size_t last = std::min(first + MergedBlock::kEdges, level.edges.size());
    for (std::size_t i = first; i < last; ++i)
      if (cannot_occlude.empty() || !cannot_occlude[level.edges[i].object]) return true;
    return false;
  };
  for_each_block(parents, [&](std::size_t block) {
    if (block < level.block_count() && casts(block)) out.push_back(static_cast<std::uint32_t>(block));
  });
  return out;
}

std::size_t MergedEdges::bytes() const {
  std::size_t sum = 0;
  for (const MergedLevel& l : levels_) sum += l.bytes();
  return sum;
}

}  // namespace penumbra::detail
