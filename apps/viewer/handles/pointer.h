// What the mouse does in the picture: turn, pan, zoom, drag the light's handles and the divider.
#pragma once

#include <optional>

#include "apps/viewer/handles/light_handles.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

class Pointer {
 public:
  /// Reads ImGui's mouse of this frame and changes the state. `frame` (may be null) tells what is under the
  /// pointer.
  void update(State& state, const Frame* frame);
  bool dragging() const { return drag_ != Drag::kNone; }
  /// Ends a drag that is under way: the light, the camera and the divider are as they were when it began.
  void cancel(State& state);
  /// The handle that is dragged or would be.
  Handle handle() const { return held_ ? held_->handle() : hovered_; }
  bool over_divider() const { return over_divider_ || drag_ == Drag::kDivider; }
  /// In the picture; none while the mouse is over the panel.
  const std::optional<PicturePoint>& at() const { return at_; }

 private:
  enum class Drag { kNone, kRotate, kPan, kHandle, kDivider };
  void press(const State& state, const Projection& projection, int button);
  void drag(State& state, const Projection& projection, double x_pixels, double y_pixels);
  void wheel(State& state, const Projection& projection, const Frame* frame, double notches) const;

  Drag drag_ = Drag::kNone;
  int button_ = 0;
  Handle hovered_ = Handle::kNone;
  bool over_divider_ = false;
  std::optional<HandleDrag> held_;
  std::optional<State> before_;  ///< the drag
  std::optional<PicturePoint> at_;
};

/// What the frame shows at a place of the picture (which may be larger than the frame's images): the point on
/// the surface, none where nothing is seen.
std::optional<std::size_t> pixel_at(const Frame& frame, const PicturePoint& at, int width, int height);

}  // namespace penumbra::viewer
