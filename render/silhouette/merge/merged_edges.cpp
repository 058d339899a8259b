#include "render/silhouette/merge/merged_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

#include "mesh/vectors.h"
#include "render/silhouette/edges/block_bounds.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kFewFaces = 1024;  // a caster's, whose edges are not merged
constexpr double kFinest = 0x1p-22;      // tolerance of the first level, in the frame of rays
constexpr int kMostLevels = 13;          // each with twice the tolerance
constexpr double kWorthWhile = 0.04;     // of the faces, at most, for the first level
constexpr double kWorthFlat = 0.3;       // the same for what is flat
constexpr double kWorthAnother = 0.75;   // of the patches of the level before, at most
constexpr double kStraight = 0x1p-36;    // of its length squared, what a straight chain sweeps by rounding
constexpr std::size_t kLanes = kFloatLanes;

/// An edge on its way through the levels.
struct Chain {
  std::uint32_t from, to, left, right;
  Vec3 swept{0.0};     ///< area between what was merged and the edge from end to end
  double stray = 0.0;  ///< how far from that edge anything merged lies
};

double cross_part(const Vec3& area, const Vec3& normal) {
  return glm::length(area - glm::dot(area, normal) * normal);
}

/// One caster: its patches, and its edges at the level at hand.
class Merger {
 public:
  explicit Merger(const TriangleMesh& mesh) : mesh_(mesh) {
    if (mesh.triangles().size() >= kFewFaces)
      tree_.emplace(mesh);
    else
      for (const Edge& e : mesh.edges()) chains_.push_back(chain_of(e));
  }

  const std::vector<Chain>& chains() const { return chains_; }
  const std::vector<FacePatch>& patches() const { return patches_; }
  /// About how many faces and patches there are at a tolerance.
  std::size_t count_parts(double tolerance) const {
    return tree_ ? tree_->count_parts(tolerance) : mesh_.triangles().size();
  }
  double deviation(const Chain& c) const {
    return std::max(error_of(c.left), error_of(c.right)) +
           swept_width(c.left, c.right, c.swept, c.from, c.to);
  }

  double margin(const Chain& c) const {
    const auto of_side = [&](std::uint32_t side) {
      if (side == MergedEdge::kNoSide || side < faces()) return 0.0;
      const FacePatch& p = patches_[side - faces()];
      return 2.0 * (p.thick + p.spread + p.radius * p.tilt);
    };
    return c.stray + std::max(of_side(c.left), of_side(c.right));
  }

  /// Merges faces, then chains of edges, to a larger tolerance than before.
  void merge(double tolerance) {
    if (!tree_) return;
    FacePatches::Partition partition = tree_->partition(tolerance);
    const auto merged = [&](std::uint32_t side) {
      if (side == MergedEdge::kNoSide) return side;
      return partition.side[side < faces() ? side : index(patches_[side - faces()].first)];
    };
    std::vector<Chain> edges;
    const auto add = [&](Chain c) {
      c.left = merged(c.left), c.right = merged(c.right);
      if (c.left == c.right) return;
      if (c.left > c.right) c = {c.to, c.from, c.right, c.left, -c.swept, c.stray};
      edges.push_back(c);
    };
    if (chains_.empty())
      for (const Edge& e : mesh_.edges()) add(chain_of(e));
    else
      for (const Chain& c : chains_) add(c);
    patches_ = std::move(partition.patches);
    join(edges, tolerance);
  }

 private:
  static Chain chain_of(const Edge& e) {
    const auto number = [](auto id) { return static_cast<std::uint32_t>(index(id)); };
    return {number(e.from), number(e.to), number(e.left),
            e.is_boundary() ? MergedEdge::kNoSide : number(e.right)};
  }
  std::size_t faces() const { return mesh_.triangles().size(); }
  double error_of(std::uint32_t side) const {
    if (side == MergedEdge::kNoSide || side < faces()) return 0.0;
    return patches_[side - faces()].error;
  }
  Vec3 normal_of(std::uint32_t side) const {
    if (side >= faces()) return patches_[side - faces()].normal;
    const IndexedTriangle& t = mesh_.triangles()[side];
    const Vec3 a = mesh_.positions()[t[0]];
    return unit(glm::cross(mesh_.positions()[t[1]] - a, mesh_.positions()[t[2]] - a));
  }

  const Vec3& position(std::uint32_t vertex) const { return mesh_.positions()[vertex]; }
  double distance_from(std::uint32_t vertex, const Chain& edge) const {
    const Vec3 a = position(edge.from), along = position(edge.to) - a, p = position(vertex) - a;
    const double t = glm::clamp(glm::dot(p, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(p, t * along);
  }

  /// How far an edge moves a silhouette sideways that has swept this area.
  double swept_width(std::uint32_t left, std::uint32_t right, const Vec3& swept, std::uint32_t from,
                     std::uint32_t to) const {
    const double length = glm::distance(position(from), position(to));
    if (!(length > 0.0)) return std::numeric_limits<double>::infinity();
    if (glm::length(swept) <= kStraight * length * length) return 0.0;
    if (right == MergedEdge::kNoSide) return glm::length(swept) / length;
    const Vec3 l = normal_of(left), r = normal_of(right), middle = unit(l + r);
    const double along = std::abs(glm::dot(swept, middle)), apart = std::min(1.0, glm::distance(l, r));
    return (cross_part(swept, middle) + along * apart) / length;
  }

  /// Two edges at most that meet in a vertex.
  struct Meeting {
    std::uint32_t count = 0, in = 0, out = 0;
  };

  /// Chains between the same two sides become one, as far as the tolerance goes.
  void join(const std::vector<Chain>& edges, double tolerance) {
    std::vector<Meeting> meetings(mesh_.positions().size());
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      Meeting &from = meetings[edges[i].from], &to = meetings[edges[i].to];
      ++from.count, ++to.count;
      from.out = i + 1, to.in = i + 1;
    }
    const auto goes_on = [&](std::uint32_t vertex) {
      const Meeting& m = meetings[vertex];
      if (m.count != 2 || m.in == 0 || m.out == 0) return false;
      const Chain &a = edges[m.in - 1], &b = edges[m.out - 1];
      return a.left == b.left && a.right == b.right;
    };
    chains_.clear();
    std::vector<char> done(edges.size(), 0);
    const auto follow = [&](std::uint32_t first) {
      std::vector<const Chain*> way{&edges[first]};
      done[first] = 1;
      while (goes_on(way.back()->to)) {
        const std::uint32_t next = meetings[way.back()->to].out - 1;
        if (done[next]) break;  // it closes up
        done[next] = 1;
        way.push_back(&edges[next]);
      }
      straighten(way, tolerance);
    };
    for (std::uint32_t i = 0; i < edges.size(); ++i)
      if (!goes_on(edges[i].from)) follow(i);
    for (std::uint32_t i = 0; i < edges.size(); ++i)
      if (!done[i]) follow(i);
  }

  /// Edges that follow on each other, as few as the tolerance allows.
  void straighten(const std::vector<const Chain*>& way, double tolerance) {
    Chain chain = *way.front();
    std::vector<std::uint32_t> passed;  // vertices that it leaves out
    const auto finish = [&] {
      double stray = 0.0;
      for (const std::uint32_t v : passed) stray = std::max(stray, distance_from(v, chain));
      chain.stray += stray;
      chains_.push_back(chain);
      passed.clear();
    };
    for (const Chain* more : std::span(way).subspan(1)) {
      const Vec3 start = position(chain.from), middle = position(chain.to);
      const Vec3 swept =
          chain.swept + more->swept + 0.5 * glm::cross(middle - start, position(more->to) - start);
      if (swept_width(chain.left, chain.right, swept, chain.from, more->to) <= tolerance) {
        passed.push_back(chain.to);
        chain.swept = swept;
        chain.to = more->to;
        chain.stray = std::max(chain.stray, more->stray);
      } else {
        finish();
        chain = *more;
      }
    }
    finish();
  }

  const TriangleMesh& mesh_;
  std::optional<FacePatches> tree_;
  std::vector<FacePatch> patches_;
  std::vector<Chain> chains_;
};

/// The frame of rays.
struct RayUnits {
  Vec3 origin;
  double scale;
  Vec3 point(const Vec3& p) const { return (p - origin) * scale; }
  Vec3 direction(const Vec3& d) const { return d; }
  double per_unit() const { return scale; }
};

struct PlacedEdge {
  std::array<float, 3> at;  ///< its middle
  MergedEdge edge;
};

std::vector<MergedEdge> neighbors_together(const Scene& scene,
                                           const std::vector<std::optional<Merger>>& mergers) {
  std::vector<PlacedEdge> placed;
  for (std::uint32_t object = 0; object < mergers.size(); ++object) {
    if (!mergers[object]) continue;
    const TriangleMesh& mesh = scene.objects[object].mesh;
    for (const Chain& c : mergers[object]->chains()) {
      const VertexId from{c.from}, to{c.to};
      const Vec3 middle = 0.5 * mesh.position(from) + 0.5 * mesh.position(to);
      placed.push_back(
          {{static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)},
           {object, from, to, c.left, c.right, static_cast<float>(mergers[object]->deviation(c)),
            static_cast<float>(1.0001 * mergers[object]->margin(c))}});
    }
  }
  order_by_place(placed.data(), placed.data() + placed.size(), kLanes);
  std::vector<MergedEdge> out;
  for (const PlacedEdge& p : placed) out.push_back(p.edge);
  return out;
}

MergedLevel make_level(const Scene& scene, const std::vector<std::optional<Merger>>& mergers,
                       const RayUnits& units) {
  MergedLevel level;
  level.patches.resize(scene.objects.size());
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
  std::vector<BlockBounds> bounds(level.block_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bounds.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      bounds[i] = level.block(scene, i, units, 1.0).bounds();
  });
  level.tree = BoundsTree(std::move(bounds), 1.0);
  return level;
}

}  // namespace

void MergedBlock::make_boxes() {
  for (std::size_t k = 0; k < count; ++k) {
    MergedSides& s = sides[k];
    Bounds box{glm::min(edges[k].a, edges[k].b) - s.margin, glm::max(edges[k].a, edges[k].b) + s.margin};
    for (const MergedSides::Side& side : {s.left, s.right})
      if (!side.is_flat) box.add(Bounds{side.center - side.radius, side.center + side.radius});
    s.middle = box.center();
    s.half = (0.5 + 0x1p-50) * (box.high - box.low);
  }
}

BlockBounds MergedBlock::bounds() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds box, normals;
  for (std::size_t k = 0; k < count; ++k)
    box.add(Bounds{sides[k].middle - sides[k].half, sides[k].middle + sides[k].half});
  BlockBounds out{box.low, box.high, Vec3(0.0), Vec3(0.0), kInfinity, -kInfinity};
  const Vec3 middle = box.center();
  const auto add = [&](const FacePlane& plane, const MergedSides::Side& s) {
    if (plane.tolerance < 0.0) {
      out.near_low = -kInfinity, out.near_high = kInfinity;
      return;
    }
    normals.add(plane.normal - s.tilt);
    normals.add(plane.normal + s.tilt);
    const double v = plane.value(middle);
    const double off = plane.tolerance + s.reach(middle);
    out.near_low = std::min(out.near_low, v - off);
    out.near_high = std::max(out.near_high, v + off);
  };
  for (std::size_t k = 0; k < count; ++k) {
    add(edges[k].left, sides[k].left);
    add(edges[k].right, sides[k].right);
  }
  out.normal_low = normals.low, out.normal_high = normals.high;
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
    return o.casts && o.mesh.triangles().size() >= kFewFaces;
  };
  if (std::ranges::none_of(scene.objects, is_large)) return;
  std::vector<std::optional<Merger>> mergers(scene.objects.size());
  tbb::parallel_for(std::size_t{0}, mergers.size(), [&](std::size_t i) {
    if (scene.objects[i].casts) mergers[i].emplace(scene.objects[i].mesh);
  });
  const auto count_parts = [&](double tolerance) {
    std::size_t sum = 0;
    for (const auto& m : mergers) sum += m ? m->count_parts(tolerance) : 0;
    return static_cast<double>(sum);
  };
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

std::vector<std::uint32_t> MergedEdges::blocks_of(const MergedLevel& level, const DiskLight& light,
                                                  std::span<const char> cannot_occlude) const {
  std::vector<NodeMask> parents;
  level.tree.collect(SidesTest(FloatDisk(light, origin_, scale_).box), parents);
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
