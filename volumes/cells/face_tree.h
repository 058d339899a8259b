// A tree of bounding boxes over faces of a mesh, which finds those near a box.
#pragma once

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

  std::vector<FaceId> order_;
  std::vector<Bounds> bounds_;  ///< of the faces in `order_`
  std::vector<Node> nodes_;
};

}  // namespace penumbra::detail
