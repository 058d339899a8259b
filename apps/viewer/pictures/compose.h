// From a frame to what is shown: the pictures of each side and their difference.
#pragma once

#include "apps/viewer/pictures/picture_texture.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

/// Of one of the frame's sides: the bytes that write_png writes over the scene's background (gray where that
/// is transparent), or the selected light's visibility or region in colors (state.h).
Pixels picture_of(const Frame& frame, const Side& side, Shown shown, double exposure);
/// The selected light's visibility on the left side minus that on the right in apps/common/picture.h's signed
/// colors, `scale` saturates them; gray where no surface is seen. Both sides have one size.
Pixels difference_of(const Frame& frame, double scale);

/// Textures side by side from the upper left, each reduced to `side` pixels, at most four in a row; a line of
/// one pixel between them. Empty where there are none.
Pixels mosaic_of(const std::vector<TexturePicture>& textures, int side);

}  // namespace penumbra::viewer
