// Silhouette method, step merge: patches of neighboring faces that a receiver may take for one face, and
// what that costs.
//
// In: a mesh, once. Out: for any tolerance the largest groups of faces that keep it.
//
// A patch counts as looking at x where its mean plane does, all of it. Where x sees it edge-on some of its
// faces look the other way. Let f's area be a_f, its signed distance from x v_f, and v the mean of v_f by
// area. The area that is taken for the wrong side, times its distance, is at most half of Σ a_f |v_f - v|
// (as much as |Σ a_f v_f| falls short of Σ a_f |v_f|). With n_f = n + t_f and c on the mean plane, |v_f -
// v| ≤ |t_f| |x - c| + |n_f·(p_f - c)|. A silhouette crosses the patch over a length of about √(Σ a_f). So
// the silhouette is displaced by no more than
//   error · |x - c|,  error = (Σ a_f |t_f| + Σ a_f |n_f·(p_f - c)| / radius) / (2 √(Σ a_f)),
// a distance on the surface times the angle under which it is seen. `radius` is that of a ball around the
// patch, and x lies outside of it.
//
// On a smooth surface the error falls with the area of the patch. Flat patches have no error, however large
// they are. So faces in one plane that hang together are put together first ("flats"; most have one face),
// and then flats that lie close together.
#pragma once

#include <array>
#include <cstdint>
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
  /// How far it displaces a silhouette, over the distance of the receiver; see above.
  double error = std::numeric_limits<double>::infinity();
  /// One of its faces.
  FaceId first{0};

  /// All faces lie in one plane, but for rounding to float.
  bool is_flat() const { return tilt <= 0x1p-14; }
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
