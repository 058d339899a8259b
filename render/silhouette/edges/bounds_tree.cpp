#include "render/silhouette/edges/bounds_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace penumbra::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Speed.
/// Groups of eight nodes that a task bounds. Seen in the benchmark `silhouette`, stage band_tree.
constexpr std::size_t kNodesPerTask = 256;

/// The bounds of several nodes together. A plane's value at the joined middle differs from that at a
/// child's middle by normal·(difference of the middles).
BlockBounds joined(const BlockBounds* first, const BlockBounds* last) {
  Bounds box, normals;
  for (const BlockBounds* n = first; n != last; ++n) {
    box.add(Bounds{n->low, n->high});
    normals.add(Bounds{n->normal_low, n->normal_high});
  }
  BlockBounds node{box.low, box.high, normals.low, normals.high, kInfinity, -kInfinity};
  const Vec3 middle = box.center();
  for (const BlockBounds* n = first; n != last; ++n) {
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

/// Up to eight nodes in float. Halves are enlarged, so that floats bound what doubles do. A lane without a
/// node counts as one-sided for all receivers, and is dropped.
Children packed(const BlockBounds* first, const BlockBounds* last, double extent) {
  const auto enlarged = [](double half, double least) {
    return static_cast<float>(half * (1.0 + 0x1p-20) + least);
  };
  Children c{};
  c.value += 1.0f;
  for (Floats& half : c.normal_half) half -= 1.0f;  // so that directions are on one side as well
  for (const BlockBounds* n = first; n != last; ++n) {
    const auto l = n - first;
    const Vec3 half = 0.5 * (n->high - n->low);
    for (int k = 0; k < 3; ++k) {
      c.middle[k][l] = static_cast<float>(0.5 * (n->low[k] + n->high[k]));
      c.half[k][l] = enlarged(half[k], 0x1p-22 * extent);
      c.normal[k][l] = static_cast<float>(0.5 * (n->normal_low[k] + n->normal_high[k]));
      c.normal_half[k][l] = enlarged(0.5 * (n->normal_high[k] - n->normal_low[k]), 0x1p-20);
    }
    c.across[l] = enlarged(std::hypot(half.x, half.y), 0x1p-22 * extent);
    const bool bounded = n->near_high < kInfinity;
    c.value[l] = bounded ? static_cast<float>(0.5 * (n->near_low + n->near_high)) : 0.0f;
    c.value_half[l] = enlarged(0.5 * (n->near_high - n->near_low), kBoundsGrain * extent);
  }
  return c;
}

/// Runs body(first, last, group) for every eight nodes.
template <class Body>
void for_each_group(const std::vector<BlockBounds>& nodes, const Body& body) {
  const std::size_t groups = (nodes.size() + BoundsTree::kFanOut - 1) / BoundsTree::kFanOut;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups, kNodesPerTask), [&](const auto& range) {
    for (std::size_t g = range.begin(); g < range.end(); ++g) {
      const std::size_t end = std::min((g + 1) * BoundsTree::kFanOut, nodes.size());
      body(nodes.data() + g * BoundsTree::kFanOut, nodes.data() + end, g);
    }
  });
}

}  // namespace

PENUMBRA_VECTOR_CLONES
std::size_t keep(const SidesTest& test, const Children* nodes, const NodeMask* in, std::size_t count,
                 NodeMask* out) {
  return keep_with(test, nodes, in, count, out);
}

BlockBounds bounds_of_edges(const BandEdge* first, const BandEdge* last) {
  Bounds box, normals;
  bool open = false;
  for (const BandEdge* e = first; e != last; ++e) {
    box.add(e->a);
    box.add(e->b);
    normals.add(e->left.normal);
    if (e->has_right()) normals.add(e->right.normal);
    open = open || !e->has_right();
  }
  if (open) return {box.low, box.high, normals.low, normals.high, -kInfinity, kInfinity};
  BlockBounds out{box.low, box.high, normals.low, normals.high, kInfinity, -kInfinity};
  const Vec3 middle = box.center();
  for (const BandEdge* e = first; e != last; ++e)
    for (const FacePlane* plane : {&e->left, &e->right}) {
      const double v = plane->value(middle);
      out.near_low = std::min(out.near_low, v - plane->tolerance);
      out.near_high = std::max(out.near_high, v + plane->tolerance);
    }
  return out;
}

BoundsTree::BoundsTree(std::vector<BlockBounds> nodes, double extent) : extent_(extent) {
  while (!nodes.empty()) {
    std::vector<BlockBounds> above((nodes.size() + kFanOut - 1) / kFanOut);
    LargeArray<Children> level(above.size());
    for_each_group(nodes, [&](const BlockBounds* first, const BlockBounds* last, std::size_t group) {
      level[group] = packed(first, last, extent);
      above[group] = joined(first, last);
    });
    levels_.push_back(std::move(level));
    nodes = std::move(above);
    if (nodes.size() > 1) continue;
    box_ = {nodes[0].low, nodes[0].high};
    return;
  }
}

void BoundsTree::narrow(const std::vector<NodeMask>& list, const SidesTest& test,
                        std::vector<NodeMask>& out) const {
  out.resize(list.size());
  if (!list.empty()) out.resize(keep(test, blocks(), list.data(), list.size(), out.data()));
}

std::size_t BoundsTree::bytes() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += level.size() * sizeof(Children);
  return sum;
}

std::size_t count_blocks(const std::vector<NodeMask>& list) {
  std::size_t sum = 0;
  for (const NodeMask& s : list) sum += static_cast<std::size_t>(std::popcount(s.kept));
  return sum;
}

}  // namespace penumbra::detail
