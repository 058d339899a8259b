// study: pictures as bytes.
#pragma once

#include <span>
#include <string>

namespace penumbra::apps {

/// A lossless WebP file of 8-bit RGB, width·height·3. Throws std::bad_alloc, and SystemError where libwebp
/// fails.
std::string encode_webp(int width, int height, std::span<const unsigned char> rgb);

}  // namespace penumbra::apps
