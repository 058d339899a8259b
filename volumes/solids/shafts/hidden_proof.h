// Solids: proofs that a convex set T sees nothing of a light D.
//
// Take the faces that meet the shaft conv(T ∪ D) and hang together there, a patch. Its boundary lies outside
// of the shaft. Where T and D do not meet the patch, the signed number of its crossings is the same for all
// segments from T to D: it can change only where a segment passes over the boundary or an end passes through
// the patch; at folds two crossings of opposite signs come or go. If that number is not 0 for one segment,
// every segment meets the patch, and T is in umbra. Edges of other layers in front or behind do not matter.
//
// A patch ends as soon as it can: at edges between faces of different classes (AllFront, Mixed, NoneFront)
// that miss the shaft. So it stays on the side of a smooth body that faces the light, whose crossings do not
// cancel with those of its back.
//
// Sets that lie together have nearly the same patch. So patches are found once for the hull of several sets
// (GroupPatches); those of each set begin with them.
#pragma once

#include <vector>

#include "volumes/solids/shafts/group_patches.h"

namespace penumbra::detail {

/// One a thread. Refers to its arguments.
class HiddenProof {
 public:
  HiddenProof(const CasterTree& tree, const CircularLight& light);

  /// Parts of the hull of these points follow, at most LightShaft::kMostPoints, in front of the light's
  /// plane. None: of no hull.
  void begin_group(std::span<const Vec3> hull);
  struct Effort {
    /// How often a triangle may be divided into four.
    int depth = 0;
    /// Else some proofs are missed that take long.
    bool thorough = true;
  };
  /// True only where all of the hull of up to three points, in that of the group, sees nothing of the light.
  bool holds(std::span<const Vec3> points, const Effort& effort);

 private:
  bool holds_undivided(std::span<const Vec3> points, bool thorough);
  enum class Answer : std::uint8_t { kHidden, kOpen, kUnknown };
  Answer by_group(const LightShaft& shaft, bool thorough);
  int sum_in(const GroupPatches::Patch& patch) const;
  bool by_patch_of(std::uint32_t first, const LightShaft& shaft);
  void begin_patch();
  void add(std::uint32_t face);
  bool grow(const LightShaft& shaft, const GroupPatches::Patch* base, const GroupPatches::Patch* opposite);

  const CasterTree& tree_;
  const CircularLight light_;
  const LightFrame frame_;
  GroupPatches group_;
  VertexPlaces places_;
  std::vector<std::uint32_t> seen_;            ///< a face's last patch
  std::uint32_t patch_ = 0, first_patch_ = 0;  ///< the last one, and the first of this shaft
  std::vector<std::uint32_t> waiting_;         ///< faces of the patch whose neighbors are still to see
  int sum_ = 0;                                ///< of the patch's crossings, with signs
  std::size_t outside_ = 0;                    ///< crossings of other faces
  std::vector<Crossing> crossings_;
};

}  // namespace penumbra::detail
