// Silhouette method, step merge: patches of neighboring faces that a receiver may take for one face, and
// what that costs.
//
// In: a mesh, once. Out: for any tolerance the largest groups of faces that keep it.
//
// A patch counts as looking at x where its mean plane does, all of it. Where x sees it edge-on some of its
// faces look the other way: they are taken for the wrong side. What that costs is bounded for every x, and
// nothing is left out of the bound.
//
// Let f's area be a_f, A = Σ a_f, its normal n_f, p_f a corner, its signed distance from x v_f; v and σ² the
// mean and the variance of v_f by area. v has the sign of the mean plane, say it is positive. Then
//   Σ_wrong a_f |v_f| = ½ Σ a_f (|v_f| - v_f) ≤ ½ A (√(σ² + v²) - v),
// since the mean of |v_f| is no more than the root of that of v_f². Let m be the mean of n_f by area, c a
// point on the mean plane, y = x - c and o_f = n_f·(c - p_f). Then A v = area · normal·y, with area = A |m|,
// and v_f - v = (n_f - m)·y + o_f. So
//   A σ ≤ √(yᵀ turned y) + shifted,  turned = A Σ a_f (n_f - m)(n_f - m)ᵀ,  shifted = √(A Σ a_f o_f²).
// Seen from x at the height H over a plane, f covers H² |v_f| ∫ w^-3 of that plane, w how far its points lie
// below x. So what is taken for the wrong side covers H²/w³ · Σ_wrong a_f |v_f| or less.
//
// `error` tells which faces to merge: it is ½ √(Σ a_f (|n_f - m| + |o_f|/radius)²). With y of length 1, a
// part of the patch with the area a has at most error · √a taken for the wrong side (Cauchy and Schwarz), and
// a silhouette crosses it over a length of about √a. So `error` is how far a silhouette is displaced, over
// the distance of the receiver. Flat faces around a bump do not make it smaller.
//
// On a smooth surface the error falls with the area of the patch. Flat patches have no error, however large
// they are. So faces in one plane that hang together are put together first ("flats"; most have one face),
// and then flats that lie close together.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/support/large_array.h"

namespace penumbra::detail {

/// Lengths are in scene units.
struct FacePatch {
  /// The center, on the mean plane, and the radius of a ball around the faces.
  Vec3 center{0.0};
  /// Unit; the mean by area.
  Vec3 normal{0.0};
  double radius = 0.0;
  /// The largest |normal of a face - normal|.
  double tilt = 0.0;
  /// The largest distance of the center from the plane of a face.
  double spread = 0.0;
  /// The largest distance of a corner from the mean plane.
  double thick = 0.0;
  /// What tells how much of it may be taken for the wrong side; see above.
  double area = 0.0, shifted = 0.0;
  glm::dmat3 turned{0.0};
  /// How far that displaces a silhouette, over the distance of the receiver; see above. A length.
  double error = std::numeric_limits<double>::infinity();
  /// One of its faces.
  FaceId first{0};

  /// All faces lie in one plane, but for rounding of doubles. What is taken for the wrong side is as little.
  bool is_flat() const { return error == 0.0; }
  /// Σ_wrong a_f |v_f| for x, or more.
  double mistaken(const Vec3& x) const {
    const Vec3 y = x - center;
    const double across = area * glm::dot(normal, y);
    const double apart = std::sqrt(std::max(0.0, glm::dot(y, turned * y))) + shifted;
    return 0.5 * (std::hypot(apart, across) - std::abs(across));
  }
};

class FacePatches {
 public:
  /// Cost O(F log F), on all cores; some 100 bytes a face.
  explicit FacePatches(const TriangleMesh& mesh);

  struct Partition {
    std::vector<FacePatch> patches;
    /// For each face the number of its patch plus the number of faces, or its own number where it stays
    /// alone.
    std::vector<std::uint32_t> side;
  };
  /// The largest patches with an error of `tolerance` (scene units) or less. Normals of their faces differ
  /// from the mean normal by less than half, so that no closed surface is within one. But for rounding,
  /// patches of a larger tolerance are unions of patches of a smaller one. Cost O(F) or a little more, on
  /// all cores.
  Partition partition(double tolerance) const;
  /// About as many patches and single faces as `partition` leaves, or fewer. Cost O(as many).
  std::size_t count_parts(double tolerance) const;

 private:
  /// Speed. Flats of a node of the lowest level, the fewest that are merged. Seen in the benchmark `growth`.
  static constexpr std::size_t kFewest = 8;

  /// Of the faces at places first to last.
  FacePatch patch(std::size_t first, std::size_t last) const;
  std::size_t flats() const { return begins_.size() - 1; }
  /// Nodes of level l are runs of kFewest · 2^l flats. The first flat behind a node.
  std::size_t last_of(std::size_t level, std::size_t node) const;
  /// Adds the flats first to last as a patch where that keeps the tolerance, else returns false.
  bool add_patch(std::size_t first, std::size_t last, double tolerance, Partition& out,
                 std::vector<FacePatch>& patches) const;
  /// Adds the patch of a node, or those of its parts, or of its flats.
  void add(std::size_t level, std::size_t node, double tolerance, Partition& out,
           std::vector<FacePatch>& patches) const;
  std::size_t count_parts(std::size_t level, std::size_t node, double tolerance) const;

  /// Faces, flat by flat; flats that lie close together follow on each other.
  std::vector<std::uint32_t> order_;
  /// Of the faces in that order.
  LargeArray<std::array<Vec3, 3>> corners_;
  /// Where each flat begins, and the end of the last.
  std::vector<std::uint32_t> begins_;
  /// For each level and node a lower bound of its error.
  std::vector<std::vector<float>> errors_;
};

}  // namespace penumbra::detail
