// The light in the picture: its rim, normal and handles, as lines over everything.
#pragma once

#include "apps/viewer/handles/light_handles.h"

struct ImDrawList;

namespace penumbra::viewer {

/// `marked` is drawn brighter and thicker.
void draw_light(ImDrawList& list, const HandledLight& light, const Projection& projection, Handle marked);

}  // namespace penumbra::viewer
