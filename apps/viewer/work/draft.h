// What is rendered while the light or the camera moves: the same method at full size where it keeps up, else
// cheaper.
#pragma once

#include <array>

#include "penumbra/render/renderer.h"

namespace penumbra::viewer {

/// What pictures took tells how fine the next draft is: as fine as is expected to take no more than the
/// budget.
class DraftPolicy {
 public:
  /// How many pixels of the window one pixel of the draft covers along each side; 1: the full picture.
  int reduction() const { return reduction_; }
  /// The options of a draft: a coarser D-buffer and fewer rays, and fewer pixels where they are reduced.
  RenderOptions draft_of(const RenderOptions& options) const;
  /// Whether a draft of full size is the picture itself.
  static bool is_as_cheap(const RenderOptions& options);
  /// Tells how long the first picture of a scene took. Later ones take less, so it decides on the first draft
  /// and nothing else.
  void start(double milliseconds);
  /// Tells how long the last draft took, all sides together, and whether the camera moved: then drafts cost
  /// more, and what is known of those of a light is forgotten.
  void took(double milliseconds, bool camera_moved);
  /// The same of a picture of full size of which a draft takes no longer, or, where it is as cheap, as long.
  void took_in_full(double milliseconds, bool camera_moved, bool as_cheap);

 private:
  static constexpr int kCoarsest = 6, kFirstPatience = 8;
  /// What drafts of one reduction took.
  struct Known {
    double milliseconds = 0.0;
    /// How many drafts it is still believed. A reduction that is too slow is tried again after that.
    int believed = 0;
    /// For how many it is when that reduction is too slow the next time: longer each time that it was tried
    /// in vain.
    int patience = kFirstPatience;
  };

  Known& known(int reduction) { return known_[static_cast<std::size_t>(reduction)]; }
  void note(int reduction, double milliseconds, bool camera_moved);
  /// What one of another reduction will take, where one of `reduction` takes so long.
  double expected(int another, int reduction, double milliseconds) const;
  void choose(int shown);

  int reduction_ = 1;
  bool camera_moved_ = false;
  /// By the reduction.
  std::array<Known, kCoarsest + 1> known_{};
};

}  // namespace penumbra::viewer
