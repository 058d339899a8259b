// Solids: patches of casters that may keep each of several sets from a light (hidden_proof.h).
//
// In the shaft of the group's hull a patch grows from a face between its middle and the light. It ends where
// nothing of it can meet the shaft, and at edges between faces of different classes that miss the shaft of
// the middle. Of the first kind of its boundary all parts of the hull are free. The second kind is looked at
// for each set: where such an edge meets its shaft, the patch grows on.
#pragma once

#include <span>
#include <vector>

#include "volumes/solids/shafts/vertex_places.h"

namespace penumbra::detail {

/// One a thread. Refers to its arguments.
class GroupPatches {
 public:
  /// An edge between a face of a patch and one that is not.
  struct Rim {
    std::uint32_t a, b;
    Vec3 at_a, at_b;
    std::uint32_t next;  ///< the other face, or CasterTree::kNoFace
  };
  struct Patch {
    std::uint32_t number = 0;
    std::vector<Rim> rim;             ///< edges to look at for each set; all others miss their shafts
    std::vector<std::uint32_t> near;  ///< faces that a set may meet; it meets no others
  };

  GroupPatches(const CasterTree& tree, const CircularLight& light, const LightFrame& frame);

  /// Finds the patches for the hull of some points.
  void find(std::span<const Vec3> hull, double extent);
  void clear() { count_ = 0; }
  std::span<const Patch> patches() const { return std::span(patches_).first(count_); }
  bool is_in(std::uint32_t face, const Patch& patch) const { return patch_of_[face] == patch.number; }

 private:
  bool grow(const LightShaft& shaft, std::uint32_t first, Patch& patch);

  const CasterTree& tree_;
  const CircularLight light_;
  const LightFrame frame_;
  VertexPlaces of_hull_, of_middle_;
  std::vector<std::uint32_t> patch_of_;  ///< a face's last patch
  std::uint32_t last_ = 0, before_ = 0;  ///< numbers of the last patch, and of that before the group's
  std::vector<Patch> patches_;
  std::size_t count_ = 0;  ///< of patches that serve
  std::vector<std::uint32_t> waiting_;
  std::vector<Crossing> crossings_;
};

}  // namespace penumbra::detail
