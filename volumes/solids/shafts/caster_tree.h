// Solids: the faces of all casters in front of a light, in a hierarchy of boxes, with their neighbors.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/predicates/predicates.h"
#include "volumes/solids/shafts/light_shaft.h"

namespace penumbra::detail {

/// A face that a segment crosses.
struct Crossing {
  std::uint32_t face;
  int sign;         ///< 1: the segment comes from behind the face
  double distance;  ///< fraction of the segment
};

class CasterTree {
 public:
  static constexpr std::uint32_t kNoFace = ~std::uint32_t{0};
  struct Face {
    std::array<Vec3, 3> corners;
    /// Across the sides 01, 12, 20; kNoFace at a boundary.
    std::array<std::uint32_t, 3> neighbors;
    std::array<std::uint32_t, 3> vertices;  ///< of all casters, below vertex_count()
    std::uint32_t component;
    FaceClass kind;
    /// Wholly and strictly in front of the light's plane.
    bool in_front;
  };

  /// Faces on or behind the light's plane are left out. Copies what it needs. Cost O(F log F), on all cores
  /// but for the tree.
  CasterTree(std::span<const TriangleMesh> casters, const CircularLight& light);

  std::span<const Face> faces() const { return faces_; }
  /// How many sets of faces there are that hang together; Face::component numbers them.
  std::size_t component_count() const { return components_; }
  std::size_t vertex_count() const { return vertices_; }
  const Bounds& bounds() const { return bounds_; }

  /// No face meets the shaft. `likely`: a face to try first; set to the one that was found. Cost O(log F +
  /// faces nearby).
  bool is_clear(const LightShaft& shaft, std::uint32_t& likely) const;
  /// Faces whose inside the segment crosses, by exact signs. `clean`: false where it touches an edge or lies
  /// in a face.
  void crossings(const Vec3& from, const Vec3& to, std::vector<Crossing>& found, bool& clean) const;

 private:
  struct Node {
    Bounds bounds;
    std::uint32_t first = 0, count = 0;  ///< a leaf's faces, or 0 and the second child
  };
  void build(std::span<std::uint32_t> order, std::size_t first, std::span<const Vec3> middles);

  std::vector<Face> faces_;
  std::vector<std::uint32_t> order_;  ///< of faces in leaves
  std::vector<Node> nodes_;
  std::size_t components_ = 0, vertices_ = 0;
  Bounds bounds_;
};

}  // namespace penumbra::detail
