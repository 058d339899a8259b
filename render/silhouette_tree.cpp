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
constexpr double kGrain = 0x1p-17;  // of the extent, see the header

/// A linear function n·p + offset, positive outside by more than the margin; and how much it varies per
/// half a box.
struct FloatPlane {
  std::array<float, 3> normal, steep;
  float offset;
};

FloatPlane float_plane(const Vec3& n, double offset, double margin) {
  FloatPlane p;
  for (int k = 0; k < 3; ++k) {
    p.normal[k] = static_cast<float>(n[k]);
    p.steep[k] = std::abs(p.normal[k]);
  }
  p.offset = static_cast<float>(offset - margin);
  return p;
}

PENUMBRA_INLINE Floats sum_of_products(const std::array<float, 3>& a, const std::array<Floats, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct FloatBox {
  std::array<float, 3> middle, half;
};

FloatBox float_box(const Vec3& middle, const Vec3& half) {
  FloatBox b;
  for (int k = 0; k < 3; ++k) {
    b.middle[k] = static_cast<float>(middle[k]);
    b.half[k] = static_cast<float>(half[k]);
  }
  return b;
}

/// All planes of the children have one sign for receivers in a box.
PENUMBRA_INLINE Ints are_one_sided(const BandTree::Children& c, const FloatBox& receivers) {
  Floats value = c.value, reach = c.value_half;
  for (int k = 0; k < 3; ++k) {
    const Floats d = receivers.middle[k] - c.middle[k];
    value += c.normal[k] * d;
    reach +=
        c.normal_half[k] * (magnitude(d) + receivers.half[k]) + magnitude(c.normal[k]) * receivers.half[k];
  }
  return magnitude(value) > reach;
}

/// A shaft in float.
struct ShaftTest {
  ShaftTest(const Shaft& shaft, double extent) : receivers(float_box(shaft.middle(), shaft.half())) {
    for (int k = 0; k <= kShaftSides; ++k) {
      const Shaft::Side side = shaft.side_plane(k);
      planes[k] = float_plane(side.normal, side.offset, kGrain * extent * (1.0 + std::abs(side.normal.z)));
    }
    has_horizon = shaft.has_horizon();
    if (!has_horizon) return;
    const Vec3 low = shaft.normal_low(), high = shaft.normal_high();
    normals = float_box(0.5 * (low + high), 0.5 * (high - low));
    lowest = static_cast<float>(shaft.lowest() - kGrain * extent);
  }
  /// Below the tangent planes of all receivers.
  PENUMBRA_INLINE Ints are_below(const BandTree::Children& c) const {
    Floats highest{};
    for (int k = 0; k < 3; ++k) {
      const Floats d = c.middle[k] - receivers.middle[k];
      highest += normals.middle[k] * d + normals.half[k] * magnitude(d) +
                 (std::abs(normals.middle[k]) + normals.half[k]) * c.half[k];
    }
    return highest < lowest;
  }
  PENUMBRA_INLINE std::uint32_t dropped(const BandTree::Children& c) const {
    Ints out = are_one_sided(c, receivers);
    for (const FloatPlane& p : planes)
      out |= sum_of_products(p.normal, c.middle) + p.offset > sum_of_products(p.steep, c.half);
    if (has_horizon) out |= are_below(c);
    return bits_of(out);
  }

  std::array<FloatPlane, kShaftSides + 1> planes;
  FloatBox receivers;
  bool has_horizon = false;
  FloatBox normals{};
  float lowest = 0.0f;
};

/// One receiver in float.
struct ConeTest {
  ConeTest(const Receiver& receiver, double extent)
      : at(float_box(receiver.x, Vec3(0.0))),
        per_z(static_cast<float>(1.0 / receiver.x.z)),
        steep((std::hypot(at.middle[0], at.middle[1]) + 1.0f) * per_z),
        margin(static_cast<float>(kGrain * extent) * (1.0f + steep)),
        tangent(float_plane(-receiver.normal, glm::dot(receiver.normal, receiver.x), kGrain * extent)) {}
  PENUMBRA_INLINE std::uint32_t dropped(const BandTree::Children& c) const {
    Ints out = are_one_sided(c, at);
    out |=
        sum_of_products(tangent.normal, c.middle) + tangent.offset > sum_of_products(tangent.steep, c.half);
    const Floats t = c.middle[2] * per_z;
    const Floats x = c.middle[0] - at.middle[0] * t, y = c.middle[1] - at.middle[1] * t;
    const Floats reach = 1.0f - t + c.across + c.half[2] * steep + margin;
    out |= (reach < 0.0f) | (x * x + y * y > reach * reach * 1.00001f);
    return bits_of(out);
  }

  FloatBox at;
  float per_z, steep, margin;
  FloatPlane tangent;
};

template <class Test>
PENUMBRA_INLINE std::size_t keep_with(const Test& test, const BandTree::Children* nodes, const Siblings* in,
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
std::size_t keep(const ShaftTest& test, const BandTree::Children* nodes, const Siblings* in,
                 std::size_t count, Siblings* out) {
  return keep_with(test, nodes, in, count, out);
}

PENUMBRA_VECTOR_CLONES
std::size_t keep(const ConeTest& test, const BandTree::Children* nodes, const Siblings* in, std::size_t count,
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
std::vector<BandTree::Children> BandTree::packed(const std::vector<Node>& nodes) const {
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
    c.value_half[l] = enlarged(0.5 * (n.near_high - n.near_low), kGrain * extent_);
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
  thread_local std::vector<Siblings> kept;
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

void BandTree::narrow(const std::vector<Siblings>& list, const Shaft& shaft,
                      std::vector<Siblings>& out) const {
  out.resize(list.size());
  if (list.empty()) return;
  out.resize(keep(ShaftTest(shaft, extent_), levels_[0].data(), list.data(), list.size(), out.data()));
}

void BandTree::narrow(const std::vector<Siblings>& list, const Receiver& receiver,
                      std::vector<Siblings>& out) const {
  out.resize(list.size());
  if (list.empty()) return;
  out.resize(keep(ConeTest(receiver, extent_), levels_[0].data(), list.data(), list.size(), out.data()));
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

void gather_edges(const Band& band, const std::vector<Siblings>& blocks, const Shaft& shaft,
                  std::vector<std::uint32_t>& out) {
  out.clear();
  for (const Siblings& s : blocks)
    for (std::uint32_t bits = s.kept; bits != 0; bits &= bits - 1) {
      const std::size_t block =
          s.parent * BandTree::kFanOut + static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t first = block * BandTree::kFanOut;
      const std::size_t last = std::min(first + BandTree::kFanOut, band.edges.size());
      for (std::size_t i = first; i < last; ++i)
        if (!shaft.never_silhouette(band.edges[i]) && !shaft.misses(band.edges[i]))
          out.push_back(static_cast<std::uint32_t>(i));
    }
}

}  // namespace penumbra::detail
