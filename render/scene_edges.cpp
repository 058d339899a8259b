#include "render/scene_edges.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "volumes/detail/vectors.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kLanes = kFloatLanes;

struct Placed {
  glm::vec3 middle;
  SceneEdge edge;
};

/// All edges of casters, as they come.
LargeArray<Placed> edges_of(const Scene& scene) {
  std::size_t size = 0;
  for (const SceneObject& o : scene.objects) size += o.casts ? o.mesh.edges().size() : 0;
  LargeArray<Placed> out(size);
  std::size_t at = 0;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const SceneObject& o = scene.objects[object];
    for (std::uint32_t i = 0; o.casts && i < o.mesh.edges().size(); ++i, ++at) {
      const Edge& e = o.mesh.edges()[i];
      out[at].middle = glm::vec3(0.5 * o.mesh.position(e.from) + 0.5 * o.mesh.position(e.to));
      out[at].edge = {object, EdgeId{i}};
    }
  }
  return out;
}

/// Puts what lies close together next to each other: halves across the longest side, down to blocks. As many
/// blocks go to the first half as the greatest power of two says, so that eight in a row are one part.
void divide(Placed* first, Placed* last) {
  const auto blocks = (static_cast<std::size_t>(last - first) + kLanes - 1) / kLanes;
  if (blocks < 2) return;
  glm::vec3 low = first->middle, high = low;
  for (const Placed* p = first; p != last; ++p) {
    low = glm::min(low, p->middle);
    high = glm::max(high, p->middle);
  }
  const glm::vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  Placed* middle = first + std::bit_floor(blocks - 1) * kLanes;
  std::nth_element(first, middle, last,
                   [axis](const Placed& p, const Placed& q) { return p.middle[axis] < q.middle[axis]; });
  constexpr std::size_t kBlocksPerTask = 64;
  if (blocks < kBlocksPerTask) {
    divide(first, middle);
    divide(middle, last);
  } else {
    tbb::parallel_invoke([=] { divide(first, middle); }, [=] { divide(middle, last); });
  }
}

LargeArray<SceneEdge> neighbours_together(LargeArray<Placed> edges) {
  divide(edges.data(), edges.data() + edges.size());
  LargeArray<SceneEdge> out(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) out[i] = edges[i].edge;
  return out;
}

/// The light in float, in the frame of the edges.
struct FloatDisk {
  std::array<float, 3> center, normal;
  float radius2, margin;
};

/// 1 or -1 where all of the disk is in front of a plane or behind it, 0 where that is not certain: a plane
/// with unit normal n is at most radius · √(1 - (n·normal)²) farther from some point than from the center.
PENUMBRA_INLINE void sides_over(const PlaneLanes& plane, const FloatDisk& disk, Ints& out) {
  const auto& [c, m, radius2, margin] = disk;
  const Floats value = plane.x * c[0] + plane.y * c[1] + plane.z * c[2] + plane.offset;
  const Floats along = plane.x * m[0] + plane.y * m[1] + plane.z * m[2];
  const Floats steep2 = 1.0f - along * along;
  const Floats none{};
  const Floats rise2 = (steep2 > 0.0f ? steep2 : none) + 0x1p-20f;
  const Floats beyond = magnitude(value) - plane.tolerance - margin;
  const Ints clear = (beyond > 0.0f) & (beyond * beyond > 1.0001f * radius2 * rise2);
  out = clear & ((value < 0.0f) - (value > 0.0f));
}

/// Bit i is clear where both faces of edge i have all of the disk on one side, the same.
PENUMBRA_VECTOR_CLONES
std::uint32_t may_be_in_band(const EdgePlanes& planes, const FloatDisk& disk) {
  Ints left, right;
  sides_over(planes.left, disk, left);
  sides_over(planes.right, disk, right);
  return bits_of(~((left == right) & (left != 0)));
}

}  // namespace

SceneEdges::SceneEdges(const Scene& scene, const Vec3& origin, double scale)
    : origin_(origin),
      scale_(scale),
      edges_(neighbours_together(edges_of(scene))),
      planes_((edges_.size() + kLanes - 1) / kLanes) {
  const auto to_frame = [&](const Vec3& p) { return (p - origin) * scale; };
  std::vector<MeshArrays> meshes;
  for (const SceneObject& o : scene.objects) meshes.emplace_back(o.mesh);
  std::vector<BlockBounds> bounds(planes_.size());
  const auto fill = [&](std::size_t block) {
    std::array<BandEdge, kLanes> edges;
    const std::size_t count = std::min(kLanes, edges_.size() - block * kLanes);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (lane >= count) {
        planes_[block].set_idle(lane);
        continue;
      }
      const SceneEdge& e = edges_[block * kLanes + lane];
      edges[lane] = meshes[e.object].edge(e.id, to_frame, 1.0);
      planes_[block].set(lane, edges[lane], 1.0);
    }
    bounds[block] = bounds_of_edges(edges.data(), edges.data() + count);
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, planes_.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) fill(i);
  });
  tree_ = BoundsTree(std::move(bounds), 1.0);
}

std::vector<SceneEdge> SceneEdges::band_of(const DiskLight& light, std::span<const char> idle) const {
  const Vec3 center = (light.center - origin_) * scale_, normal = unit(light.normal);
  const double radius = light.radius * scale_;
  // The light may lie farther out than it did when the frame was made.
  const double extent = std::max(1.0, largest_component(center) + radius);
  const Vec3 half = radius * glm::sqrt(glm::max(Vec3(0.0), 1.0 - normal * normal));
  const FloatDisk disk{FloatBox(center, half).middle, FloatBox(normal, half).middle,
                       static_cast<float>(radius * radius), static_cast<float>(0x1p-18 * extent)};
  std::vector<Siblings> parents;
  tree_.gather(SidesTest(center, half + kBoundsGrain * extent), parents);
  constexpr std::size_t kRun = 256;
  std::vector<std::vector<SceneEdge>> runs((parents.size() + kRun - 1) / kRun);
  const auto add_block = [&](std::size_t block, std::vector<SceneEdge>& out) {
    for (std::uint32_t bits = may_be_in_band(planes_[block], disk); bits != 0; bits &= bits - 1) {
      const SceneEdge& e = edges_[block * kLanes + static_cast<std::size_t>(std::countr_zero(bits))];
      if (idle.empty() || !idle[e.object]) out.push_back(e);
    }
  };
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t run) {
    for (std::size_t i = run * kRun; i < std::min(parents.size(), (run + 1) * kRun); ++i)
      for (std::uint32_t bits = parents[i].kept; bits != 0; bits &= bits - 1)
        add_block(parents[i].parent * kLanes + static_cast<std::size_t>(std::countr_zero(bits)), runs[run]);
  });
  std::vector<SceneEdge> out;
  for (const auto& run : runs) out.insert(out.end(), run.begin(), run.end());
  return out;
}

std::size_t SceneEdges::bytes() const {
  return edges_.size() * sizeof(SceneEdge) + planes_.size() * sizeof(EdgePlanes) + tree_.bytes();
}

}  // namespace penumbra::detail
