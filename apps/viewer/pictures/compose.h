// From a frame to what is shown: the pictures of each side and their difference.
#pragma once

#include "apps/viewer/pictures/picture_texture.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

/// The bytes that write_png writes, or another channel in colours (state.h).
Pixels picture_of(const Side& side, Shown shown, double exposure);
/// Visibility of the left side minus that of the right in apps/common/picture.h's signed colours, `scale` saturates
/// them; grey where no surface is seen. Both sides have one size.
Pixels difference_of(const Side& left, const Side& right, double scale);

/// Textures side by side from the upper left, each reduced to `side` pixels, at most four in a row; a line of
/// one pixel between them. Empty where there are none.
Pixels mosaic_of(const std::vector<TexturePicture>& textures, int side);

}  // namespace penumbra::viewer
