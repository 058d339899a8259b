// What a D-buffer's textures hold, as pictures to look at.
#pragma once

#include <vector>

#include "penumbra/render/support/texture_picture.h"
#include "render/d_buffer/layers.h"

namespace penumbra::detail {

/// Of the first target: the first surface, penumbra entries, umbra entries before and behind the last
/// surface; none that are empty. Each by number, one gray a number, and by depth, what is nearer to the light
/// brighter. Replaces the attachments of the framebuffer that is bound. Cost O(texels), read back.
std::vector<TexturePicture> pictures_of(const gl::Functions& gl, const DBufferLayers& layers);

}  // namespace penumbra::detail
