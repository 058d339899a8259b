#include "render/silhouette_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace penumbra::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Test>
PENUMBRA_INLINE std::size_t keep_with(const Test& test, const Children* nodes, const Siblings* in,
                                      std::size_t count, Siblings* out) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Siblings s = in[i];
    const std::uint32_t kept = s.kept & ~test.dropped(nodes[s.parent]);
    out[found] = {s.parent, kept};
    found += kept != 0 ? 1 : 0;
  }
  return found;
}

PENUMBRA_VECTOR_CLONES
std::size_t keep(const ShaftTest& test, const Children* nodes, const Siblings* in, std::size_t count,
                 Siblings* out) {
  return keep_with(test, nodes, in, count, out);
}

PENUMBRA_VECTOR_CLONES
std::size_t keep(const SidesTest& test, const Children* nodes, const Siblings* in, std::size_t count,
                 Siblings* out) {
  return keep_with(test, nodes, in, count, out);
}

}  // namespace

/// Bounds while the tree is built.
struct BandTree::Node {
  Vec3 low, high;                ///< of the edges
  Vec3 normal_low, normal_high;  ///< of their faces' planes
  double near_low, near_high;    ///< of the planes' values at the box's middle, tolerance included
};

BandTree::BandTree(const Band& band) : extent_(band.extent) {
  std::vector<Node> nodes((band.edges.size() + kFanOut - 1) / kFanOut);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 512), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      nodes[i] = node_of(band, i * kFanOut, std::min((i + 1) * kFanOut, band.edges.size()));
  });
  for (const Node& n : nodes) box_.add(Bounds{n.low, n.high});
  if (!nodes.empty()) levels_.push_back(packed(nodes));
  while (nodes.size() > kFanOut) {
    std::vector<Node> above;
    for (std::size_t i = 0; i < nodes.size(); i += kFanOut)
      above.push_back(joined(nodes.data() + i, nodes.data() + std::min(i + kFanOut, nodes.size())));
    nodes = std::move(above);
    levels_.push_back(packed(nodes));
  }
}

BandTree::Node BandTree::node_of(const Band& band, std::size_t first, std::size_t last) const {
  Bounds box, normals;
  bool open = false;
  for (std::size_t i = first; i < last; ++i) {
    const BandEdge& e = band.edges[i];
    box.add(e.a);
    box.add(e.b);
    normals.add(e.left.normal);
    if (e.has_right) normals.add(e.right.normal);
    open = open || !e.has_right;
  }
  if (open) return {box.low, box.high, normals.low, normals.high, -kInfinity, kInfinity};
  Node node{box.low, box.high, normals.low, normals.high, kInfinity, -kInfinity};
  const Vec3 middle = box.center();
  for (std::size_t i = first; i < last; ++i)
    for (const FacePlane* plane : {&band.edges[i].left, &band.edges[i].right}) {
      const double v = plane->value(middle);
      node.near_low = std::min(node.near_low, v - plane->tolerance);
      node.near_high = std::max(node.near_high, v + plane->tolerance);
    }
  return node;
}

/// A plane's value at the joined middle differs from that at the child's by normal·(difference of middles).
BandTree::Node BandTree::joined(const Node* first, const Node* last) {
  Bounds box, normals;
  for (const Node* n = first; n != last; ++n) {
    box.add(Bounds{n->low, n->high});
    normals.add(Bounds{n->normal_low, n->normal_high});
  }
  Node node{box.low, box.high, normals.low, normals.high, kInfinity, -kInfinity};
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

/// Halves are enlarged so that floats bound what doubles do. A child that is none has one side for all.
std::vector<Children> BandTree::packed(const std::vector<Node>& nodes) const {
  std::vector<Children> out((nodes.size() + kFanOut - 1) / kFanOut);
  const auto enlarged = [](double half, double least) {
    return static_cast<float>(half * (1.0 + 0x1p-20) + least);
  };
  for (Children& c : out) {
    c = Children{};
    c.value += 1.0f;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& n = nodes[i];
    Children& c = out[i / kFanOut];
    const std::size_t l = i % kFanOut;
    const Vec3 half = 0.5 * (n.high - n.low);
    for (int k = 0; k < 3; ++k) {
      c.middle[k][l] = static_cast<float>(0.5 * (n.low[k] + n.high[k]));
      c.half[k][l] = enlarged(half[k], 0x1p-22 * extent_);
      c.normal[k][l] = static_cast<float>(0.5 * (n.normal_low[k] + n.normal_high[k]));
      c.normal_half[k][l] = enlarged(0.5 * (n.normal_high[k] - n.normal_low[k]), 0x1p-22);
    }
    c.across[l] = enlarged(std::hypot(half.x, half.y), 0x1p-22 * extent_);
    const bool bounded = n.near_high < kInfinity;
    c.value[l] = bounded ? static_cast<float>(0.5 * (n.near_low + n.near_high)) : 0.0f;
    c.value_half[l] = enlarged(0.5 * (n.near_high - n.near_low), kBoundsGrain * extent_);
  }
  return out;
}

bool BandTree::misses(const Shaft& shaft) const {
  return levels_.empty() || shaft.misses(box_.low, box_.high);
}

void BandTree::gather(const Shaft& shaft, std::vector<Siblings>& out) const {
  out.clear();
  if (levels_.empty()) return;
  const ShaftTest test(shaft, extent_);
  std::vector<Siblings> kept;
  out.push_back({0, (1u << kFanOut) - 1});
  for (std::size_t level = levels_.size(); level-- > 0;) {
    kept.resize(out.size());
    kept.resize(keep(test, levels_[level].data(), out.data(), out.size(), kept.data()));
    if (level == 0) return std::swap(out, kept);
    out.clear();
    for (const Siblings& s : kept)
      for (std::uint32_t bits = s.kept; bits != 0; bits &= bits - 1)
        out.push_back({s.parent * static_cast<std::uint32_t>(kFanOut) +
                           static_cast<std::uint32_t>(std::countr_zero(bits)),
                       (1u << kFanOut) - 1});
  }
}

void BandTree::narrow(const std::vector<Siblings>& list, std::span<const Receiver> receivers,
                      std::vector<Siblings>& out) const {
  Bounds box;
  for (const Receiver& r : receivers) box.add(r.x);
  const SidesTest test(box.center(), 0.5 * (box.high - box.low));
  out.resize(list.size());
  if (!list.empty()) out.resize(keep(test, levels_[0].data(), list.data(), list.size(), out.data()));
}

std::size_t BandTree::bytes() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += level.size() * sizeof(Children);
  return sum;
}

std::size_t count_blocks(const std::vector<Siblings>& list) {
  std::size_t sum = 0;
  for (const Siblings& s : list) sum += static_cast<std::size_t>(std::popcount(s.kept));
  return sum;
}

}  // namespace penumbra::detail
