// Handles by which the light is moved, tilted and resized in the picture.
//
// A distant light has no place: it is turned by its center, which slides over a sphere around the casters,
// and by its normal; its rim changes its angle.
//
// In: light, projection. Out: where the handles are seen, which one is under the pointer, and the light after
// a drag. No drawing and no window here.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/viewer/handles/handled_light.h"
#include "apps/viewer/handles/projection.h"

namespace penumbra::viewer {

enum class Handle { kNone, kAxisX, kAxisY, kAxisZ, kCenter, kRim, kNormal };
inline constexpr std::array kAxisHandles{Handle::kAxisX, Handle::kAxisY, Handle::kAxisZ};
const char* name_of(Handle handle);

/// Places in the world, sized so that arrows are about equally long in the picture wherever the light is.
struct HandleShape {
  Vec3 center;
  std::vector<Vec3> axis_tips;  ///< three, none for a distant light
  Vec3 normal_tip;
  Vec3 rim_knob;  ///< where the rim's knob is drawn, for a distant light outside of its small rim; the whole
                  ///< rim can be dragged
  std::vector<Vec3> rim;  ///< closed polygon, the first corner not repeated
};
HandleShape handle_shape(const HandledLight& light, const Projection& projection);

/// The handle within `reach` pixels of the pointer: tips and center before axes before the rim.
Handle pick(const HandleShape& shape, const Projection& projection, const PicturePoint& pointer,
            double reach = 9.0);

/// A drag from press to release. The light follows the pointer without a jump at the start.
class HandleDrag {
 public:
  /// `aim`: where a near light keeps shining while it is moved; none: it keeps its direction.
  HandleDrag(Handle handle, const HandledLight& light, const Projection& projection,
             const PicturePoint& start, const std::optional<Vec3>& aim = std::nullopt);
  Handle handle() const { return handle_; }
  /// The light as it was when the drag began.
  const HandledLight& start() const { return start_; }
  /// The light for this place of the pointer; the light at the start where the drag has no meaning there (its
  /// axis along the line of sight, say).
  HandledLight moved_to(const Projection& projection, const PicturePoint& pointer) const;

 private:
  std::optional<Vec3> grip(const Projection& projection, const PicturePoint& pointer) const;

  Handle handle_;
  HandledLight start_;
  std::optional<Vec3> aim_;
  double arm_;  ///< length of the normal's arrow, scene units
  std::optional<Vec3> start_grip_;
};

}  // namespace penumbra::viewer
