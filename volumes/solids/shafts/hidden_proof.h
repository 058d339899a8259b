// Solids: proofs that a convex set T sees nothing of a light D.
//
// Take the faces that meet the shaft conv(T ∪ D) and hang together there, a patch. Its boundary lies outside of the shaft.
// Where T and D do not meet the patch, the signed number of its crossings is the same for all segments from T to D: it can
// change only where a segment passes over the boundary or an end passes through the patch; at folds two crossings of opposite
// signs come or go. If that number is not 0 for one segment, every segment meets the patch, and T is in umbra. Edges of
// other layers in front or behind do not matter.
//
// Two patches are tried at each crossing of one segment: faces that do not look away from the whole light (or all that do),
// so that the patch ends at a silhouette; and faces of any kind.
#pragma once

#include <vector>

#include "volumes/solids/shafts/caster_tree.h"

namespace penumbra::detail {

/// One a thread. Refers to its arguments.
class HiddenProof {
 public:
  HiddenProof(const CasterTree& tree, const CircularLight& light);

  /// True only where all of the hull of up to three points sees nothing of the light: with the light as it is, or divided
  /// into smaller disks that cover it. `depth`: how often the points, and the light, may be divided.
  bool holds(std::span<const Vec3> points, int depth);

 private:
  bool holds_undivided(std::span<const Vec3> points, const CircularLight& light);
  bool separates(const LightShaft& shaft, std::uint32_t first, bool one_kind);
  std::uint32_t sides_beyond(const LightShaft& shaft, const CasterTree::Face& face, int corner);

  const CasterTree& tree_;
  const CircularLight light_;
  const LightFrame frame_;
  double extent_;
  /// A face's last patch, of all kinds and of one kind.
  std::array<std::vector<std::uint32_t>, 2> seen_;
  std::uint32_t patch_ = 0, first_patch_ = 0;  ///< the last one, and the first of this shaft
  std::vector<std::uint32_t> beyond_;          ///< a vertex's sides, as of the shaft below
  std::vector<std::uint32_t> beyond_of_;
  std::uint32_t shaft_ = 0;
  std::vector<std::uint32_t> waiting_;
  std::vector<Crossing> crossings_;
};

}  // namespace penumbra::detail
