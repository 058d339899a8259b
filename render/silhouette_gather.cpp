#include "render/silhouette_gather.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/vector_clones.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kFanOut = 8;

struct Directions {
  Directions() {
    for (int k = 0; k < kShaftSides; ++k) {
      x[k] = std::cos(2.0 * std::numbers::pi * k / kShaftSides);
      y[k] = std::sin(2.0 * std::numbers::pi * k / kShaftSides);
    }
  }
  alignas(64) std::array<double, kShaftSides> x, y;
};
const Directions kDirections;

/// Bits of x spread so that two others fit between them.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

std::uint64_t morton_code(const Vec3& p, const Bounds& box) {
  std::uint64_t code = 0;
  for (int k = 0; k < 3; ++k) {
    const double size = box.high[k] - box.low[k];
    const double t = size > 0.0 ? std::clamp((p[k] - box.low[k]) / size, 0.0, 1.0) : 0.0;
    code |= spread_bits(static_cast<std::uint64_t>(t * 0x1fffff)) << k;
  }
  return code;
}

std::vector<BandEdge> along_curve(const std::vector<BandEdge>& edges) {
  Bounds box;
  for (const BandEdge& e : edges) box.add(0.5 * (e.a + e.b));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    order[i] = {morton_code(0.5 * (edges[i].a + edges[i].b), box), i};
  tbb::parallel_sort(order.begin(), order.end());  // all different: one order
  std::vector<BandEdge> sorted;
  sorted.reserve(edges.size());
  for (const auto& [code, i] : order) sorted.push_back(edges[i]);
  return sorted;
}

/// The largest slopes that receivers ask for, direction by direction.
PENUMBRA_VECTOR_CLONES
void tighten_slopes(const Receiver* receivers, std::size_t count, double* __restrict slope) {
  const double *cosine = kDirections.x.data(), *sine = kDirections.y.data();
  alignas(64) double most[kShaftSides];
  for (int k = 0; k < kShaftSides; ++k) most[k] = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& p = receivers[i].x;
    const double per_z = 1.0 / p.z, px = p.x * per_z, py = p.y * per_z;
    for (int k = 0; k < kShaftSides; ++k) {
      const double s = cosine[k] * px + sine[k] * py - per_z;
      most[k] = s > most[k] ? s : most[k];
    }
  }
  for (int k = 0; k < kShaftSides; ++k) slope[k] = most[k];
}

/// Whether a box lies beyond one of the shaft's sides, d·p.xy - 1 - slope p.z > 0. All sides at once, without
/// branches.
PENUMBRA_VECTOR_CLONES
bool box_is_beyond(const Vec3& low, const Vec3& high, const double* slope, double margin) {
  const double *cosine = kDirections.x.data(), *sine = kDirections.y.data();
  const double x0 = low.x, x1 = high.x, y0 = low.y, y1 = high.y, z0 = low.z, z1 = high.z;
  int any = 0;
  for (int k = 0; k < kShaftSides; ++k) {
    const double x = cosine[k] > 0.0 ? cosine[k] * x0 : cosine[k] * x1;
    const double y = sine[k] > 0.0 ? sine[k] * y0 : sine[k] * y1;
    const double z = slope[k] > 0.0 ? slope[k] * z1 : slope[k] * z0;
    any |= x + y - 1.0 - z > margin * (1.0 + std::abs(slope[k])) ? 1 : 0;
  }
  return any != 0;
}

/// The same for an edge.
PENUMBRA_VECTOR_CLONES
bool edge_is_beyond(const Vec3& a, const Vec3& b, const double* slope, double margin) {
  const double *cosine = kDirections.x.data(), *sine = kDirections.y.data();
  const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
  int any = 0;
  for (int k = 0; k < kShaftSides; ++k) {
    const double at_a = cosine[k] * ax + sine[k] * ay - 1.0 - slope[k] * az;
    const double at_b = cosine[k] * bx + sine[k] * by - 1.0 - slope[k] * bz;
    any |= (at_a < at_b ? at_a : at_b) > margin * (1.0 + std::abs(slope[k])) ? 1 : 0;
  }
  return any != 0;
}

/// Half the range of n·p over a box of the given half size.
double reach(const Vec3& n, const Vec3& half) {
  return std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
}

}  // namespace

Shaft::Shaft(std::span<const Receiver> receivers, double extent) : margin_(0x1p-44 * extent) {
  Bounds box;
  for (const Receiver& r : receivers) box.add(r.x);
  top_ = box.high.z;
  middle_ = box.center();
  half_ = 0.5 * (box.high - box.low);
  for (int k = 0; k < kShaftSides; ++k) {
    const double x = kDirections.x[k], y = kDirections.y[k];
    const double beyond = x * middle_.x + y * middle_.y + std::abs(x) * half_.x + std::abs(y) * half_.y - 1.0;
    slope_[k] = beyond / (beyond > 0.0 ? box.low.z : box.high.z);
  }
}

void Shaft::tighten(std::span<const Receiver> receivers) {
  tighten_slopes(receivers.data(), receivers.size(), slope_.data());
  horizon_ =
      std::any_of(receivers.begin(), receivers.end(), [](const Receiver& r) { return r.horizon_cuts; });
  if (!horizon_) return;
  Bounds normals;
  lowest_ = 0.0;
  for (const Receiver& r : receivers) {
    normals.add(r.normal);
    lowest_ = std::min(lowest_, glm::dot(r.normal, r.x - middle_));
  }
  normal_low_ = normals.low;
  normal_high_ = normals.high;
}

Shaft::Side Shaft::side_plane(int k) const {
  if (k == kShaftSides) return {{0.0, 0.0, 1.0}, -top_};
  return {{kDirections.x[k], kDirections.y[k], -slope_[k]}, -1.0};
}

bool Shaft::below_horizons(const Vec3& p) const {
  const Vec3 d = p - middle_;
  double highest = 0.0;
  for (int k = 0; k < 3; ++k) highest += std::max(normal_low_[k] * d[k], normal_high_[k] * d[k]);
  return highest < lowest_ - margin_;
}

bool Shaft::misses(const Vec3& low, const Vec3& high) const {
  return low.z > top_ + margin_ || box_is_beyond(low, high, slope_.data(), margin_);
}

bool Shaft::misses(const BandEdge& e) const {
  if (std::min(e.a.z, e.b.z) > top_ + margin_) return true;
  if (edge_is_beyond(e.a, e.b, slope_.data(), margin_)) return true;
  return horizon_ && below_horizons(e.a) && below_horizons(e.b);
}

bool Shaft::never_silhouette(const BandEdge& e) const {
  if (!e.has_right) return false;
  const double left = e.left.value(middle_), right = e.right.value(middle_);
  if ((left > 0.0) != (right > 0.0)) return false;
  return std::abs(left) > reach(e.left.normal, half_) + e.left.tolerance &&
         std::abs(right) > reach(e.right.normal, half_) + e.right.tolerance;
}

BandTree::BandTree(Band& band) : band_(band) {
  band.edges = along_curve(band.edges);
  std::vector<Node> leaves((band.edges.size() + kFanOut - 1) / kFanOut);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.size(), 512), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      leaves[i] = node_of(i * kFanOut, std::min((i + 1) * kFanOut, band.edges.size()));
  });
  levels_.push_back(std::move(leaves));
  while (levels_.back().size() > 1) {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> above;
    for (std::size_t i = 0; i < below.size(); i += kFanOut)
      above.push_back(joined(below.data() + i, below.data() + std::min(i + kFanOut, below.size())));
    levels_.push_back(std::move(above));
  }
}

BandTree::Node BandTree::node_of(std::size_t first, std::size_t last) const {
  Bounds box, normals;
  bool open = false;
  for (std::size_t i = first; i < last; ++i) {
    const BandEdge& e = band_.edges[i];
    box.add(e.a);
    box.add(e.b);
    normals.add(e.left.normal);
    if (e.has_right) normals.add(e.right.normal);
    open = open || !e.has_right;
  }
  Node node{box.low, box.high, normals.low, normals.high, 0.0, 0.0, open};
  const Vec3 middle = box.center();
  bool any = false;
  const auto add = [&](const FacePlane& plane) {
    const double v = plane.value(middle);
    node.near_low = any ? std::min(node.near_low, v - plane.tolerance) : v - plane.tolerance;
    node.near_high = any ? std::max(node.near_high, v + plane.tolerance) : v + plane.tolerance;
    any = true;
  };
  for (std::size_t i = first; i < last; ++i) {
    add(band_.edges[i].left);
    if (band_.edges[i].has_right) add(band_.edges[i].right);
  }
  return node;
}

/// A plane's value at the joined middle differs from that at the child's by normal·(difference of middles).
BandTree::Node BandTree::joined(const Node* first, const Node* last) {
  Bounds box, normals;
  bool open = false;
  for (const Node* n = first; n != last; ++n) {
    box.add(Bounds{n->low, n->high});
    normals.add(Bounds{n->normal_low, n->normal_high});
    open = open || n->open;
  }
  Node node{box.low, box.high, normals.low, normals.high, 0.0, 0.0, open};
  node.near_low = std::numeric_limits<double>::infinity();
  node.near_high = -node.near_low;
  const Vec3 middle = box.center();
  for (const Node* n = first; n != last; ++n) {
    const Vec3 d = middle - 0.5 * (n->low + n->high);
    double low = n->near_low, high = n->near_high;
    for (int k = 0; k < 3; ++k) {
      low += std::min(n->normal_low[k] * d[k], n->normal_high[k] * d[k]);
      high += std::max(n->normal_low[k] * d[k], n->normal_high[k] * d[k]);
    }
    node.near_low = std::min(node.near_low, low);
    node.near_high = std::max(node.near_high, high);
  }
  return node;
}

/// All planes of the node are positive, or all negative, for every receiver of the shaft.
bool BandTree::one_sided(const Node& node, const Shaft& shaft) {
  if (node.open) return false;
  const Vec3 d = shaft.middle() - 0.5 * (node.low + node.high), half = shaft.half();
  double low = node.near_low, high = node.near_high;
  for (int k = 0; k < 3; ++k) {
    const double from = d[k] - half[k], to = d[k] + half[k];
    const double p = node.normal_low[k] * from, q = node.normal_low[k] * to;
    const double r = node.normal_high[k] * from, s = node.normal_high[k] * to;
    low += std::min(std::min(p, q), std::min(r, s));
    high += std::max(std::max(p, q), std::max(r, s));
  }
  return low > shaft.margin() || high < -shaft.margin();
}

void BandTree::visit(const Shaft& shaft, std::size_t level, std::size_t node,
                     std::vector<std::uint32_t>& out) const {
  const Node& n = levels_[level][node];
  if (shaft.misses(n.low, n.high) || one_sided(n, shaft)) return;
  const std::size_t first = node * kFanOut;
  if (level > 0) {
    const std::size_t last = std::min(first + kFanOut, levels_[level - 1].size());
    for (std::size_t i = first; i < last; ++i) visit(shaft, level - 1, i, out);
    return;
  }
  const std::size_t last = std::min(first + kFanOut, band_.edges.size());
  for (std::size_t i = first; i < last; ++i) {
    const BandEdge& e = band_.edges[i];
    if (!shaft.never_silhouette(e) && !shaft.misses(e)) out.push_back(static_cast<std::uint32_t>(i));
  }
}

bool BandTree::misses(const Shaft& shaft) const {
  return levels_.back().empty() || shaft.misses(levels_.back()[0].low, levels_.back()[0].high);
}

void BandTree::gather(const Shaft& shaft, std::vector<std::uint32_t>& out) const {
  if (!levels_.back().empty()) visit(shaft, levels_.size() - 1, 0, out);
}

std::size_t BandTree::bytes() const {
  std::size_t nodes = 0;
  for (const auto& level : levels_) nodes += level.size();
  return nodes * sizeof(Node) + band_.edges.size() * sizeof(BandEdge);
}

}  // namespace penumbra::detail
