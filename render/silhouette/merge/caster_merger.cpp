#include "render/silhouette/merge/caster_merger.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>

#include "mesh/vectors.h"
#include "render/silhouette/merge/merged_block.h"

namespace penumbra::detail {
namespace {

// Accuracy.
/// A chain is straight where it sweeps less than that, over its length squared: rounding. Held by the tests
/// MergedEdges.OfASheetAreItsSides and MergedEdges.LeaveFewEdgesOfFineSurfaces.
constexpr double kStraight = 0x1p-36;

EdgeChain chain_of(const Edge& e) {
  const auto number = [](auto id) { return static_cast<std::uint32_t>(index(id)); };
  return {number(e.from), number(e.to), number(e.left),
          e.is_boundary() ? MergedEdge::kNoSide : number(e.right)};
}

/// The length of the part of an area across a normal.
double cross_part(const Vec3& area, const Vec3& normal) {
  return glm::length(area - glm::dot(area, normal) * normal);
}

/// The edges that meet in a vertex: how many, and of two the one that ends and the one that begins there,
/// each plus 1.
struct Meeting {
  std::uint32_t count = 0, in = 0, out = 0;
};

}  // namespace

CasterMerger::CasterMerger(const TriangleMesh& mesh) : mesh_(mesh) {
  if (mesh.triangles().size() >= kFewestFaces)
    tree_.emplace(mesh);
  else
    for (const Edge& e : mesh.edges()) chains_.push_back(chain_of(e));
}

std::size_t CasterMerger::count_parts(double tolerance) const {
  return tree_ ? tree_->count_parts(tolerance) : mesh_.triangles().size();
}

double CasterMerger::deviation(const EdgeChain& c) const {
  return std::max(error_of(c.left), error_of(c.right)) + swept_width(c.left, c.right, c.swept, c.from, c.to);
}

double CasterMerger::margin(const EdgeChain& c) const {
  const auto of_side = [&](std::uint32_t side) {
    if (side == MergedEdge::kNoSide || side < faces()) return 0.0;
    const FacePatch& p = patches_[side - faces()];
    return 2.0 * (p.thick + p.spread + p.radius * p.tilt);
  };
  return c.stray + std::max(of_side(c.left), of_side(c.right));
}

void CasterMerger::merge(double tolerance) {
  if (!tree_) return;
  // The larger patches, and which of them a side now belongs to.
  FacePatches::Partition partition = tree_->partition(tolerance);
  const auto merged = [&](std::uint32_t side) {
    if (side == MergedEdge::kNoSide) return side;
    return partition.side[side < faces() ? side : index(patches_[side - faces()].first)];
  };

  // Edges between two of them, the side of the lower number on the left.
  std::vector<EdgeChain> edges;
  const auto add = [&](EdgeChain c) {
    c.left = merged(c.left), c.right = merged(c.right);
    if (c.left == c.right) return;
    if (c.left > c.right) c = {c.to, c.from, c.right, c.left, -c.swept, c.stray};
    edges.push_back(c);
  };
  if (chains_.empty())
    for (const Edge& e : mesh_.edges()) add(chain_of(e));
  else
    for (const EdgeChain& c : chains_) add(c);
  patches_ = std::move(partition.patches);

  join(edges, tolerance);
}

double CasterMerger::error_of(std::uint32_t side) const {
  if (side == MergedEdge::kNoSide || side < faces()) return 0.0;
  return patches_[side - faces()].error;
}

Vec3 CasterMerger::normal_of(std::uint32_t side) const {
  if (side >= faces()) return patches_[side - faces()].normal;
  const IndexedTriangle& t = mesh_.triangles()[side];
  const Vec3 a = mesh_.positions()[t[0]];
  return unit(glm::cross(mesh_.positions()[t[1]] - a, mesh_.positions()[t[2]] - a));
}

double CasterMerger::distance_from(std::uint32_t vertex, const EdgeChain& edge) const {
  const Vec3 a = position(edge.from), along = position(edge.to) - a, p = position(vertex) - a;
  const double t = glm::clamp(glm::dot(p, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::distance(p, t * along);
}

/// How far an edge displaces a silhouette that leaves its chain by the area `swept`.
double CasterMerger::swept_width(std::uint32_t left, std::uint32_t right, const Vec3& swept,
                                 std::uint32_t from, std::uint32_t to) const {
  const double length = glm::distance(position(from), position(to));
  if (!(length > 0.0)) return std::numeric_limits<double>::infinity();
  if (glm::length(swept) <= kStraight * length * length) return 0.0;
  if (right == MergedEdge::kNoSide) return glm::length(swept) / length;
  const Vec3 l = normal_of(left), r = normal_of(right), middle = unit(l + r);
  const double along = std::abs(glm::dot(swept, middle)), apart = std::min(1.0, glm::distance(l, r));
  return (cross_part(swept, middle) + along * apart) / length;
}

/// Chains between the same two sides become one, as far as the tolerance allows.
void CasterMerger::join(const std::vector<EdgeChain>& edges, double tolerance) {
  // Which edges meet where.
  std::vector<Meeting> meetings(mesh_.positions().size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    Meeting &from = meetings[edges[i].from], &to = meetings[edges[i].to];
    ++from.count, ++to.count;
    from.out = i + 1, to.in = i + 1;
  }
  const auto goes_on = [&](std::uint32_t vertex) {
    const Meeting& m = meetings[vertex];
    if (m.count != 2 || m.in == 0 || m.out == 0) return false;
    const EdgeChain &a = edges[m.in - 1], &b = edges[m.out - 1];
    return a.left == b.left && a.right == b.right;
  };

  // Follow each chain from its first edge, then those that close up from any edge.
  chains_.clear();
  std::vector<char> done(edges.size(), 0);
  const auto follow = [&](std::uint32_t first) {
    std::vector<const EdgeChain*> way{&edges[first]};
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

/// Replaces edges that follow on each other by as few as the tolerance allows.
void CasterMerger::straighten(const std::vector<const EdgeChain*>& way, double tolerance) {
  EdgeChain chain = *way.front();
  std::vector<std::uint32_t> passed;  // vertices that it leaves out
  const auto finish = [&] {
    double stray = 0.0;
    for (const std::uint32_t v : passed) stray = std::max(stray, distance_from(v, chain));
    chain.stray += stray;
    chains_.push_back(chain);
    passed.clear();
  };
  for (const EdgeChain* more : std::span(way).subspan(1)) {
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

}  // namespace penumbra::detail
