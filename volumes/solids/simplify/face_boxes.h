// Solids: boxes around the triangles of a surface that changes, to find those near a triangle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

inline bool overlap(const Bounds& a, const Bounds& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// A tree over the triangles as they are at first. It keeps its shape; boxes follow their triangles.
class FaceBoxes {
 public:
  FaceBoxes() = default;
  explicit FaceBoxes(std::vector<Bounds> boxes);

  /// The box of a triangle that has changed; an empty one where it is gone. Cost O(log n).
  void set(std::uint32_t face, const Bounds& box);

  /// Calls visit(face) for triangles whose box meets `box`, until it returns false. False where it has.
  template <class Visit>
  bool for_each(const Bounds& box, const Visit& visit) const {
    if (nodes_.empty()) return true;
    std::uint32_t stack[64];
    int depth = 0;
    stack[depth++] = 1;
    while (depth > 0) {
      const std::uint32_t at = stack[--depth];
      if (!overlap(nodes_[at], box)) continue;
      if (at >= leaves_) {
        if (at - leaves_ < faces_.size() && !visit(faces_[at - leaves_])) return false;
        continue;
      }
      stack[depth++] = 2 * at + 1;
      stack[depth++] = 2 * at;
    }
    return true;
  }

 private:
  void order(std::span<std::uint32_t> part, std::span<const Vec3> middles, std::uint32_t leaves);

  std::uint32_t leaves_ = 1;            ///< a power of two; node i has the children 2i and 2i + 1
  std::vector<Bounds> nodes_;           ///< from 1 on
  std::vector<std::uint32_t> faces_;    ///< of leaves
  std::vector<std::uint32_t> leaf_of_;  ///< of faces
};

}  // namespace penumbra::detail
