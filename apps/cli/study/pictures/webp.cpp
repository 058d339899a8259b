#include "apps/cli/study/pictures/webp.h"

#include <webp/encode.h>

#include <memory>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {

std::string encode_webp(int width, int height, std::span<const unsigned char> rgb) {
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGB(rgb.data(), width, height, 3 * width, &bytes);
  const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> owner(bytes, WebPFree);
  if (size == 0) throw SystemError("a picture of the study cannot be encoded as WebP");
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace penumbra::apps
