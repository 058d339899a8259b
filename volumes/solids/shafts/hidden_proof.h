// Solids: proofs that a convex set T sees nothing of a light D.
//
// Take the faces that meet the shaft conv(T ∪ D) and hang together there, a patch. Its boundary lies outside of the shaft.
// Where T and D do not meet the patch, the signed number of its crossings is the same for all segments from T to D: it can
// change only where a segment passes over the boundary or an end passes through the patch; at folds two crossings of opposite
// signs come or go. If that number is not 0 for one segment, every segment meets the patch, and T is in umbra. Edges of
// other layers in front or behind do not matter.
//
// A patch ends as soon as it can: at edges between faces of different classes (AllFront, Mixed, NoneFront) that miss the shaft.
// So it stays on the side of a smooth body that faces the light, whose crossings do not cancel with those of its back.
#pragma once

#include <vector>

#include "volumes/solids/shafts/caster_tree.h"

namespace penumbra::detail {

/// One a thread. Refers to its arguments.
class HiddenProof {
 public:
  HiddenProof(const CasterTree& tree, const CircularLight& light);

  /// True only where all of the hull of up to three points sees nothing of the light. `depth`: how often a triangle may be
  /// divided into four.
  bool holds(std::span<const Vec3> points, int depth);

 private:
  bool holds_undivided(std::span<const Vec3> points);
  bool separates(const LightShaft& shaft, std::uint32_t first);
  std::uint32_t sides_beyond(const LightShaft& shaft, const CasterTree::Face& face, int corner);

  const CasterTree& tree_;
  const CircularLight light_;
  const LightFrame frame_;
  std::vector<std::uint32_t> seen_;            ///< a face's last patch
  std::uint32_t patch_ = 0, first_patch_ = 0;  ///< the last one, and the first of this shaft
  std::vector<std::uint32_t> beyond_;          ///< a vertex's sides, as of the shaft below
  std::vector<std::uint32_t> beyond_of_;
  std::uint32_t shaft_ = 0;
  std::vector<std::uint32_t> waiting_;
  std::vector<Crossing> crossings_;
};

}  // namespace penumbra::detail
