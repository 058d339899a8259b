// Patches: neighboring faces that a receiver may take for one, and how far that moves a silhouette.
//
// In: a mesh, once. Out: for any tolerance the largest groups of faces that keep it. A patch counts as
// looking at x where its mean plane does, all of it. Where it is seen edge-on, some of its faces look the
// other way: with f's area a_f and signed distance v_f from x, what is taken for the wrong side has at most
// half of Σ a_f |v_f - v| for its measure, v their mean (as much as |Σ v| falls short of Σ |v|). With n_f = n
// + t_f and c on the mean plane |v_f - v| ≤ |t_f| |x - c| + |n_f·(p_f - c)|, so that a silhouette that
// crosses the patch, over a length of about √(Σ a_f), moves by no more than
//   error · |x - c|,  error = (Σ a_f |t_f| + Σ a_f |n_f·(p_f - c)| / radius) / (2 √(Σ a_f)),
// seen as a distance on the surface times the angle under which it is seen; radius is that of a ball around
// the patch, and x outside of it. On a smooth surface the error falls with the patch's area, by a few
// thousandths of what it spans; flat ones have none, however large they are. So faces in one plane that hang
// together are put together first ("flats"; most have one face), and then flats that lie close together.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/support/large_array.h"

namespace penumbra::detail {

struct FacePatch {
  Vec3 center{0.0};     ///< on the mean plane, of a ball around the faces
  Vec3 normal{0.0};     ///< unit, the mean by area
  double radius = 0.0;  ///< of that ball; scene units
  double tilt = 0.0;    ///< largest |normal of a face - normal|
  double spread = 0.0;  ///< largest distance of the center from a face's plane; scene units
  double thick = 0.0;   ///< largest distance of a corner from the mean plane; scene units
  double error = std::numeric_limits<double>::infinity();  ///< above; scene units
  FaceId first{0};                                         ///< one of its faces

  /// But for rounding to float.
  bool is_flat() const { return tilt <= 0x1p-14; }
};

class FacePatches {
 public:
  /// Cost O(F log F), on all cores; some 100 bytes a face.
  explicit FacePatches(const TriangleMesh& mesh);

  struct Partition {
    std::vector<FacePatch> patches;
    std::vector<std::uint32_t> side;  ///< of each face: its patch's number + the number of faces, or its own
                                      ///< number where it stays alone
  };
  /// The largest patches with an error of `tolerance` or less, whose faces' normals differ from their mean's
  /// by less than half (so that no closed surface is within one). Those of a larger tolerance are, but for
  /// rounding, unions of those of a smaller one. Cost O(F) or a little more, on all cores.
  Partition partition(double tolerance) const;
  /// About as many patches and single faces as `partition` would leave, or fewer. Cost O(as many).
  std::size_t count_parts(double tolerance) const;

 private:
  static constexpr std::size_t kFewest = 8;  // flats that are merged

  FacePatch patch(std::size_t first, std::size_t last) const;
  std::size_t flats() const { return begins_.size() - 1; }
  /// The first flat behind a node.
  std::size_t last_of(std::size_t level, std::size_t node) const;
  bool add_patch(std::size_t first, std::size_t last, double tolerance, Partition& out,
                 std::vector<FacePatch>& patches) const;
  void add(std::size_t level, std::size_t node, double tolerance, Partition& out,
           std::vector<FacePatch>& patches) const;
  std::size_t count_parts(std::size_t level, std::size_t node, double tolerance) const;

  std::vector<std::uint32_t> order_;         ///< faces, flat by flat, those that lie close together in a row
  LargeArray<std::array<Vec3, 3>> corners_;  ///< of those
  std::vector<std::uint32_t> begins_;        ///< where each flat begins; one more
  std::vector<std::vector<float>> errors_;   ///< at least, of 8, 16, 32... flats in a row
};

}  // namespace penumbra::detail
