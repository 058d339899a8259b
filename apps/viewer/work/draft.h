// What is rendered while the light or the camera moves: the same method, cheaper, so that the picture keeps
// up.
#pragma once

#include "penumbra/render/renderer.h"

namespace penumbra::viewer {

class DraftPolicy {
 public:
  /// How many pixels of the window one pixel of the draft covers along each side; 1: the full picture.
  int reduction() const { return reduction_; }
  /// The options of a draft: fewer pixels, a coarser D-buffer, fewer rays.
  RenderOptions draft_of(const RenderOptions& options) const;
  /// Tells how long the last draft took, all sides together; the next one becomes coarser or finer for it.
  void took(double milliseconds);

 private:
  int reduction_ = 2;
};

}  // namespace penumbra::viewer
