#include "volumes/cells/face_tree.h"

#include <algorithm>
#include <numeric>

namespace penumbra::detail {

namespace {

Bounds box_of(const TriangleMesh& mesh, FaceId f) {
  Bounds box;
  for (const std::uint32_t v : mesh.triangles()[index(f)]) box.add(mesh.positions()[v]);
  return box;
}

}  // namespace

FaceTree::FaceTree(const TriangleMesh& mesh, std::span<const FaceId> faces)
    : order_(faces.begin(), faces.end()) {
  for (const FaceId f : order_) bounds_.push_back(box_of(mesh, f));
  if (!order_.empty()) build(0, order_.size());
}

/// Halves the range at the median of its longest side.
void FaceTree::build(std::size_t begin, std::size_t end) {
  constexpr std::size_t kLeaf = 4;
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  for (std::size_t k = begin; k < end; ++k) nodes_[self].box.add(bounds_[k]);
  if (end - begin <= kLeaf) {
    nodes_[self].begin = begin;
    nodes_[self].end = end;
  } else {
    const Vec3 size = nodes_[self].box.high - nodes_[self].box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::size_t middle = (begin + end) / 2;
    std::vector<std::size_t> rank(end - begin);
    std::iota(rank.begin(), rank.end(), begin);
    const auto place = [&](std::size_t k) { return bounds_[k].low[axis] + bounds_[k].high[axis]; };
    std::nth_element(
        rank.begin(), rank.begin() + static_cast<std::ptrdiff_t>(middle - begin), rank.end(),
        [&](std::size_t a, std::size_t b) { return place(a) < place(b) || (place(a) == place(b) && a < b); });
    std::vector<FaceId> order;
    std::vector<Bounds> bounds;
    for (const std::size_t k : rank) {
      order.push_back(order_[k]);
      bounds.push_back(bounds_[k]);
    }
    std::copy(order.begin(), order.end(), order_.begin() + static_cast<std::ptrdiff_t>(begin));
    std::copy(bounds.begin(), bounds.end(), bounds_.begin() + static_cast<std::ptrdiff_t>(begin));
    build(begin, middle);
    build(middle, end);
  }
  nodes_[self].skip = nodes_.size();
}

}  // namespace penumbra::detail
