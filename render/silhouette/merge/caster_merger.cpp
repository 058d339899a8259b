#include "render/silhouette/merge/caster_merger.h"

#include <algorithm>
#include <cmath>
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
/// A chain is straight where it strays less than that, over its length: rounding. Held by the tests
/// MergedEdges.OfASheetAreItsSides and MergedEdges.LeaveFewEdgesOfFineSurfaces.
constexpr double kStraight = 0x1p-36;

EdgeChain chain_of(const Edge& e) {
  const auto number = [](auto id) { return static_cast<std::uint32_t>(index(id)); };
  return {number(e.from), number(e.to), number(e.left),
          e.is_boundary() ? MergedEdge::kNoSide : number(e.right)};
}

/// The point of the segment a b that is nearest to p.
Vec3 nearest(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  return a + glm::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0) * along;
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
  return std::max(error_of(c.left), error_of(c.right)) + left_by(c);
}

double CasterMerger::swept(const EdgeChain& c) const {
  return c.across + c.along * slant(c).tilted;
}

double CasterMerger::swept_at_any(const EdgeChain& c) const {
  return c.along * slant(c).thick;
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
  std::vector<Vec3> before;  // the directions halfway between their sides' normals, for those that stray
  const auto add = [&](EdgeChain c) {
    const std::uint32_t left = merged(c.left), right = merged(c.right);
    if (left == right) return;
    if (c.stray > 0.0) before.push_back(middle_of(c.left, c.right));
    c.left = left, c.right = right;
    if (left > right) std::swap(c.from, c.to), std::swap(c.left, c.right);
    edges.push_back(c);
  };
  if (chains_.empty())
    for (const Edge& e : mesh_.edges()) add(chain_of(e));
  else
    for (const EdgeChain& c : chains_) add(c);
  patches_ = std::move(partition.patches);

  // What lay along the old sides lies along the new ones, but for how much these are turned.
  auto old = before.begin();
  for (EdgeChain& c : edges) {
    if (!(c.stray > 0.0)) continue;
    const Vec3 now = middle_of(c.left, c.right), was = *old++;
    const double turned = std::min(glm::distance(now, was), glm::distance(now, -was));
    const double across = c.across, along = c.along;
    c.across += turned * along, c.along += turned * across;
    c.lift = std::min(c.stray, c.lift + turned * c.stray);
  }
  join(edges, tolerance);
}

double CasterMerger::error_of(std::uint32_t side) const {
  if (side == MergedEdge::kNoSide || side < faces()) return 0.0;
  return patches_[side - faces()].error;
}

double CasterMerger::thick_of(std::uint32_t side) const {
  return side == MergedEdge::kNoSide || side < faces() ? 0.0 : patches_[side - faces()].thick;
}

double CasterMerger::radius_of(std::uint32_t side) const {
  return side == MergedEdge::kNoSide || side < faces() ? 0.0 : patches_[side - faces()].radius;
}

Vec3 CasterMerger::normal_of(std::uint32_t side) const {
  if (side >= faces()) return patches_[side - faces()].normal;
  const IndexedTriangle& t = mesh_.triangles()[side];
  const Vec3 a = mesh_.positions()[t[0]];
  return unit(glm::cross(mesh_.positions()[t[1]] - a, mesh_.positions()[t[2]] - a));
}

Vec3 CasterMerger::middle_of(std::uint32_t left, std::uint32_t right) const {
  return right == MergedEdge::kNoSide ? normal_of(left) : unit(normal_of(left) + normal_of(right));
}

CasterMerger::Slant CasterMerger::slant(const EdgeChain& c) const {
  if (c.right == MergedEdge::kNoSide) return {1.0, 0.0};
  const Vec3 l = normal_of(c.left), r = normal_of(c.right);
  const double apart = glm::distance(l, r), both = glm::length(l + r);
  if (apart >= both) return {1.0, 0.0};
  return {apart / both, 2.0 * std::max(thick_of(c.left), thick_of(c.right)) / both};
}

double CasterMerger::left_by(const EdgeChain& c) const {
  const Slant s = slant(c);
  const double radius = std::max(radius_of(c.left), radius_of(c.right));
  return c.lift + c.stray * std::min(1.0, s.tilted + (s.thick > 0.0 ? s.thick / radius : 0.0));
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
  std::vector<const EdgeChain*> way;
  const auto follow = [&](std::uint32_t first) {
    way = {&edges[first]};
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

/// One edge in place of edges that follow on each other. Its `stray` is infinite where it has no length.
EdgeChain CasterMerger::joined(std::span<const EdgeChain* const> way) const {
  EdgeChain out = *way.front();
  out.to = way.back()->to;
  const Vec3 from = position(out.from), to = position(out.to);
  const double length = glm::distance(from, to);
  if (!(length > 0.0)) {
    out.stray = out.lift = std::numeric_limits<double>::infinity();
    return out;
  }
  const Vec3 normal = middle_of(out.left, out.right);
  double stray = 0.0, lift = 0.0, along = 0.0, across = 0.0;
  const auto add = [&](const Vec3& area) {
    const double part = glm::dot(area, normal);
    along += std::abs(part);
    across += glm::length(area - part * normal);
  };
  Vec3 before = from, foot_before = from;
  for (const EdgeChain* c : way) {
    const Vec3 p = position(c->to), foot = nearest(from, to, p), off = p - foot;
    stray = std::max(stray, glm::length(off));
    lift = std::max(lift, std::abs(glm::dot(off, normal)));
    add(0.5 * glm::cross(p - before, foot - before));
    add(0.5 * glm::cross(foot - before, foot_before - before));
    before = p, foot_before = foot;
    if (c == way.front()) continue;
    out.along += c->along, out.across += c->across;
    out.stray = std::max(out.stray, c->stray), out.lift = std::max(out.lift, c->lift);
  }
  if (stray <= kStraight * length) return out;
  out.along += along, out.across += across;
  out.stray += stray, out.lift += lift;
  return out;
}

/// Replaces edges that follow on each other by as few as the tolerance allows: from each on as many as will
/// do, looked for by steps that double and halve. Cost O(edges · log edges).
void CasterMerger::straighten(std::span<const EdgeChain* const> way, double tolerance) {
  while (!way.empty()) {
    EdgeChain chain = *way.front();
    std::size_t count = 1;
    bool doubles = true;
    for (std::size_t step = 1; step > 0;) {
      const std::size_t more = std::min(step, way.size() - count);
      if (more == 0) break;
      const EdgeChain longer = joined(way.first(count + more));
      const bool holds = left_by(longer) <= tolerance;
      if (holds) chain = longer, count += more;
      doubles = doubles && holds;
      step = doubles ? 2 * step : step / 2;
    }
    chains_.push_back(chain);
    way = way.subspan(count);
  }
}

}  // namespace penumbra::detail
