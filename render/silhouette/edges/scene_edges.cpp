#include "render/silhouette/edges/scene_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "mesh/vectors.h"
#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kLanes = kFloatLanes;

// Speed. Seen in the benchmark `silhouette`, stage band.
/// Bytes that the processor fetches at once.
constexpr std::size_t kCacheLine = 64;
/// Blocks that a task fills.
constexpr std::size_t kBlocksPerTask = 256;
/// Entries of a list of blocks that a task tests.
constexpr std::size_t kMasksPerTask = 256;

/// An edge and its middle.
struct Placed {
  std::array<float, 3> at;
  SceneEdge edge;
};

/// All edges of casters, in the order of the scene.
LargeArray<Placed> edges_of(const Scene& scene) {
  std::size_t size = 0;
  for (const SceneObject& o : scene.objects) size += o.casts ? o.mesh.edges().size() : 0;
  LargeArray<Placed> out(size);
  std::size_t at = 0;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const SceneObject& o = scene.objects[object];
    for (std::uint32_t i = 0; o.casts && i < o.mesh.edges().size(); ++i, ++at) {
      const Edge& e = o.mesh.edges()[i];
      const glm::vec3 middle(0.5 * o.mesh.position(e.from) + 0.5 * o.mesh.position(e.to));
      out[at].at = {middle.x, middle.y, middle.z};
      out[at].edge = {object, EdgeId{i}};
    }
  }
  return out;
}

LargeArray<SceneEdge> neighbors_together(LargeArray<Placed> edges) {
  order_by_place(edges.data(), edges.data() + edges.size(), kLanes);
  LargeArray<SceneEdge> out(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) out[i] = edges[i].edge;
  return out;
}

/// The side of eight planes on which the disk lies: 1 or -1, or 0 where that is not certain. c: the disk's
/// homogeneous center in the coordinates of the planes. The distance of a plane with unit normal n from a
/// point of the disk differs from that from the center by at most radius · √(1 - (n·normal)²).
PENUMBRA_INLINE void sides_over(const PlaneLanes& plane, const FloatDisk& disk, const std::array<float, 3>& c,
                                Ints& out) {
  const auto& m = disk.normal;
  const Floats value = plane.x * c[0] + plane.y * c[1] + plane.z * c[2] + disk.weight * plane.offset;
  const Floats along = plane.x * m[0] + plane.y * m[1] + plane.z * m[2];
  const Floats steep2 = 1.0f - along * along;
  const Floats none{};
  const Floats rise2 = (steep2 > 0.0f ? steep2 : none) + 0x1p-20f;
  const Floats beyond = magnitude(value) - disk.weight * plane.tolerance - disk.margin;
  const Ints clear = (beyond > 0.0f) & (beyond * beyond > 1.0001f * disk.radius2 * rise2);
  out = clear & ((value < 0.0f) - (value > 0.0f));
}

/// Bit i is clear where both faces of edge i are certain to have the disk on the same side.
PENUMBRA_VECTOR_CLONES
std::uint32_t may_be_in_band(const LocalPlanes& block, const FloatDisk& disk) {
  const std::array<float, 3> center = block.from_origin(disk.center, disk.weight);
  Ints left, right;
  sides_over(block.planes.left, disk, center, left);
  sides_over(block.planes.right, disk, center, right);
  return bits_of(~((left == right) & (left != 0)));
}

}  // namespace

namespace {

/// A circular light in homogeneous coordinates that are at most about 1.
struct ScaledDisk {
  Vec3 center;
  double weight, radius;
};

ScaledDisk scaled_disk(const CircularLight& light, const Vec3& origin, double scale) {
  if (light.is_distant()) return {-unit(light.normal), 0.0, light.radius};
  const Vec3 center = (light.center - origin) * scale;
  const double radius = light.radius * scale, reach = largest_component(center) + radius;
  // A power of two, so that nothing rounds.
  const double weight = reach > 1.0 ? std::exp2(-std::ceil(std::log2(reach))) : 1.0;
  return {center * weight, weight, radius * weight};
}

}  // namespace

FloatDisk::FloatDisk(const CircularLight& light, const Vec3& origin, double scale)
    : center(scaled_disk(light, origin, scale).center) {
  const ScaledDisk disk = scaled_disk(light, origin, scale);
  const Vec3 unit_normal = unit(light.normal);
  const double extent = std::max(1.0, disk.radius);  // the angle of a distant light may be large
  const Vec3 half = disk.radius * glm::sqrt(glm::max(Vec3(0.0), 1.0 - unit_normal * unit_normal));
  weight = static_cast<float>(disk.weight);
  box = FloatBox(disk.center, half + kBoundsGrain * extent);
  normal = FloatBox(unit_normal, half).middle;
  radius2 = static_cast<float>(disk.radius * disk.radius);
  margin = static_cast<float>(0x1p-18 * extent);
}

SceneEdges::SceneEdges(const Scene& scene, const Vec3& origin, double scale)
    : origin_(origin),
      scale_(scale),
      edges_(neighbors_together(edges_of(scene))),
      planes_((edges_.size() + kLanes - 1) / kLanes) {
  const auto to_frame = [&](const Vec3& p) { return (p - origin) * scale; };
  std::vector<MeshArrays> meshes;
  for (const SceneObject& o : scene.objects) meshes.emplace_back(o.mesh);
  std::vector<BlockBounds> bounds(planes_.size());
  const auto fill = [&](std::size_t block) {
    // The block's edges in the frame.
    std::array<BandEdge, kLanes> edges;
    const std::size_t first = block * kLanes, count = std::min(kLanes, edges_.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const SceneEdge& e = edges_[first + lane];
      edges[lane] = meshes[e.object].edge(e.id, to_frame, 1.0);
    }
    // Their planes in float, and their bounds.
    LocalPlanes& planes = planes_[block];
    planes.origin = FloatBox(edges[0].a, Vec3(0.0)).middle;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lane < count ? planes.set(lane, edges[lane]) : planes.planes.set_none(lane);
    bounds[block] = bounds_of_edges(edges.data(), edges.data() + count);
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, planes_.size(), kBlocksPerTask),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) fill(i);
                    });
  tree_ = BoundsTree(std::move(bounds), 1.0);
  for (const SceneObject& o : scene.objects)
    points_.push_back(o.casts ? PointGroups(o.mesh.positions()) : PointGroups());
}

void SceneEdges::add_block(std::size_t block, std::uint32_t edges, std::span<const char> cannot_occlude,
                           std::vector<SceneEdge>& out) const {
  // Lanes without an edge are in no light's band, but for a distant one's.
  if (edges_.size() - block * kLanes < kLanes) edges &= (1u << (edges_.size() - block * kLanes)) - 1u;
  for (; edges != 0; edges &= edges - 1) {
    const SceneEdge& e = edges_[block * kLanes + static_cast<std::size_t>(std::countr_zero(edges))];
    if (cannot_occlude.empty() || !cannot_occlude[e.object]) out.push_back(e);
  }
}

std::vector<SceneEdge> SceneEdges::band_of(const CircularLight& light,
                                           std::span<const char> cannot_occlude) const {
  const FloatDisk disk(light, origin_, scale_);
  // Blocks whose faces do not all look at the light or all away from it.
  std::vector<NodeMask> parents;
  tree_.collect(SidesTest(disk.box, disk.weight), parents);

  // Of these, edge by edge.
  std::vector<std::vector<SceneEdge>> runs((parents.size() + kMasksPerTask - 1) / kMasksPerTask);
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t run) {
    const std::size_t first = run * kMasksPerTask, count = std::min(kMasksPerTask, parents.size() - first);
    for_each_block(std::span(parents).subspan(first, count), [&](std::size_t block) {
      add_block(block, may_be_in_band(planes_[block], disk), cannot_occlude, runs[run]);
    });
  });
  std::vector<SceneEdge> out;
  for (const auto& run : runs) out.insert(out.end(), run.begin(), run.end());
  return out;
}

std::size_t SceneEdges::size_of_band(const CircularLight& light) const {
  const FloatDisk disk(light, origin_, scale_);
  return tree_.count_at_most(SidesTest(disk.box, disk.weight)) * kLanes;
}

/// Which edges have a face on either side of a receiver is asked in float. Whether they lie below its
/// tangent plane is asked in double, since receivers lie so little above their surfaces. Planes and ends of
/// edges lie anywhere in memory, so they are fetched ahead of their use.
void SceneEdges::mark_needed(const ReceiverRegion& region, const Scene& scene,
                             std::vector<std::atomic<std::uint8_t>>& needed) const {
  /// Some edges of a block, as bits, for one receiver.
  struct Question {
    std::size_t block, receiver;
    std::uint32_t lanes;
  };
  // Blocks that the region does not drop, then receiver by receiver.
  std::vector<NodeMask> parents;
  tree_.collect(region, parents);
  std::vector<Question> asked, questions;
  for (std::size_t r = 0; r < region.receivers().size(); ++r)
    for (const NodeMask& s : parents)
      for_each_block(std::array{NodeMask{s.parent, kept_by(region.receivers()[r], tree_.blocks(), s)}},
                     [&](std::size_t block) {
                       for (std::size_t line = 0; line < sizeof(LocalPlanes); line += kCacheLine)
                         __builtin_prefetch(reinterpret_cast<const char*>(&planes_[block]) + line);
                       asked.push_back({block, r, 0});
                     });

  // Of their edges those that may be a silhouette for the receiver.
  for (Question& q : asked) {
    q.lanes = may_be_silhouettes(planes_[q.block], region.receivers()[q.receiver].at());
    if (q.lanes != 0) questions.push_back(q);
  }
  const auto for_each_edge = [&](const auto& visit) {
    for (const Question& q : questions)
      for (std::uint32_t lanes = q.lanes; lanes != 0; lanes &= lanes - 1) {
        const SceneEdge& e = edges_[q.block * kLanes + static_cast<std::size_t>(std::countr_zero(lanes))];
        visit(q, lanes & -lanes, scene.objects[e.object].mesh, e.id);
      }
  };

  // Of these, those with an end above its tangent plane.
  for_each_edge([](const Question&, std::uint32_t, const TriangleMesh& mesh, EdgeId id) {
    __builtin_prefetch(&mesh.edges()[index(id)]);
  });
  for_each_edge([](const Question&, std::uint32_t, const TriangleMesh& mesh, EdgeId id) {
    const Edge& e = mesh.edges()[index(id)];
    __builtin_prefetch(&mesh.positions()[index(e.from)]);
    __builtin_prefetch(&mesh.positions()[index(e.to)]);
  });
  for_each_edge([&](const Question& q, std::uint32_t lane, const TriangleMesh& mesh, EdgeId id) {
    const Edge& e = mesh.edges()[index(id)];
    const ReceiverRegion::Point& r = region.receivers()[q.receiver];
    const auto is_below = [&](VertexId v) { return r.is_below((mesh.position(v) - origin_) * scale_); };
    if (!is_below(e.from) || !is_below(e.to)) needed[q.block] |= static_cast<std::uint8_t>(lane);
  });
}

std::vector<SceneEdge> SceneEdges::band_for(std::span<const ReceiverRegion> regions, const Scene& scene,
                                            const CircularLight& light,
                                            std::span<const char> cannot_occlude) const {
  std::vector<std::atomic<std::uint8_t>> needed(planes_.size());
  tbb::parallel_for(std::size_t{0}, regions.size(),
                    [&](std::size_t i) { mark_needed(regions[i], scene, needed); });
  const FloatDisk disk(light, origin_, scale_);
  std::vector<SceneEdge> out;
  for (std::size_t block = 0; block < needed.size(); ++block)
    if (needed[block] != 0)
      add_block(block, needed[block] & may_be_in_band(planes_[block], disk), cannot_occlude, out);
  return out;
}

std::size_t SceneEdges::bytes() const {
  std::size_t sum = edges_.size() * sizeof(SceneEdge) + planes_.size() * sizeof(LocalPlanes) + tree_.bytes();
  for (const PointGroups& p : points_) sum += p.bytes();
  return sum;
}

}  // namespace penumbra::detail
