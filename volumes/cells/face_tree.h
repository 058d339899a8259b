// A tree of bounding boxes over faces of a mesh, which finds those near a box and those near each other.
#pragma once

#include <tbb/parallel_invoke.h>

#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

class FaceTree {
 public:
  /// Keeps a reference to `mesh`. Cost O(n log n) for n faces.
  FaceTree(const TriangleMesh& mesh, std::span<const FaceId> faces);

  /// Calls visit(face) for every face whose bounding box meets `box`, until it returns false. Boxes are
  /// closed, and comparisons exact. Returns true if visit never returned false. The order is that of the
  /// tree.
  template <class Visit>
  bool for_each_near(const Bounds& box, Visit visit) const {
    std::size_t i = 0;
    while (i < nodes_.size()) {
      const Node& node = nodes_[i];
      if (!meet(node.box, box)) {
        i = node.skip;
        continue;
      }
      for (std::size_t k = node.begin; k < node.end; ++k) {
        if (meet(bounds_[k], box) && !visit(order_[k])) return false;
      }
      ++i;
    }
    return true;
  }

  /// Calls visit(face, face) once for every two faces whose bounding boxes meet, in any order and on all
  /// cores.
  template <class Visit>
  void for_each_near_pair(const Visit& visit) const {
    if (!nodes_.empty()) pairs_in(0, visit);
  }

 private:
  /// Nodes are stored in the order of a walk from the root; `skip` is where it goes on without the subtree.
  struct Node {
    Bounds box;
    std::size_t skip = 0;
    std::size_t begin = 0, end = 0;  ///< of `order_`; none in an inner node
  };

  static bool meet(const Bounds& a, const Bounds& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
  }
  void build(std::size_t begin, std::size_t end);
  bool is_leaf(std::size_t i) const { return nodes_[i].end > nodes_[i].begin; }
  std::size_t left(std::size_t i) const { return i + 1; }
  std::size_t right(std::size_t i) const { return nodes_[i + 1].skip; }
  std::size_t size(std::size_t i) const { return nodes_[i].skip - i; }

  template <class Visit>
  void pairs_in(std::size_t i, const Visit& visit) const {
    constexpr std::size_t kForOneCore = 512;  // nodes
    if (is_leaf(i)) {
      for (std::size_t k = nodes_[i].begin; k < nodes_[i].end; ++k)
        for (std::size_t l = k + 1; l < nodes_[i].end; ++l)
          if (meet(bounds_[k], bounds_[l])) visit(order_[k], order_[l]);
    } else if (size(i) > kForOneCore) {
      tbb::parallel_invoke([&] { pairs_in(left(i), visit); }, [&] { pairs_in(right(i), visit); },
                           [&] { pairs_between(left(i), right(i), visit); });
    } else {
      pairs_in(left(i), visit);
      pairs_in(right(i), visit);
      pairs_between(left(i), right(i), visit);
    }
  }

  template <class Visit>
  void pairs_between(std::size_t i, std::size_t j, const Visit& visit) const {
    if (!meet(nodes_[i].box, nodes_[j].box)) return;
    if (is_leaf(i) && is_leaf(j)) {
      for (std::size_t k = nodes_[i].begin; k < nodes_[i].end; ++k)
        for (std::size_t l = nodes_[j].begin; l < nodes_[j].end; ++l)
          if (meet(bounds_[k], bounds_[l])) visit(order_[k], order_[l]);
    } else if (is_leaf(i) || (!is_leaf(j) && size(j) > size(i))) {
      pairs_between(i, left(j), visit);
      pairs_between(i, right(j), visit);
    } else {
      pairs_between(left(i), j, visit);
      pairs_between(right(i), j, visit);
    }
  }

  std::vector<FaceId> order_;
  std::vector<Bounds> bounds_;  ///< of the faces in `order_`
  std::vector<Node> nodes_;
};

}  // namespace penumbra::detail
