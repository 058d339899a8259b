#include "render/d_buffer/pictures.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace penumbra::detail {
namespace {

/// Numbers differ from their neighbors' by a gray that can be told apart; 0 stays 0.
std::uint8_t gray_of(std::uint32_t number) {
  return number ? static_cast<std::uint8_t>(56u + (number * 2654435761u >> 16) % 200u) : std::uint8_t{0};
}

/// Depths where there is a number. They fall with the distance from the light.
std::vector<std::uint8_t> grays_of(std::span<const std::uint32_t> numbers, std::span<const float> depths) {
  float low = 1.0f, high = 0.0f;
  for (std::size_t i = 0; i < depths.size(); ++i)
    if (numbers[i]) low = std::min(low, depths[i]), high = std::max(high, depths[i]);
  std::vector<std::uint8_t> out(depths.size(), 0);
  const float scale = 199.0f / std::max(high - low, 1e-6f);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (numbers[i]) out[i] = static_cast<std::uint8_t>(56.0f + scale * (depths[i] - low));
  return out;
}

}  // namespace

std::vector<TexturePicture> pictures_of(const gl::Functions& gl, const DBufferLayers& layers) {
  const auto entries = [&](EntryKind kind) { return layers.layer_of(kind, 0); };
  const struct {
    const char* name;
    const Layer& from;
    int layer;
  } shown[] = {{"first surface", layers.occluder, 0},
               {"penumbra", layers.first_entries, entries(EntryKind::kPenumbra)},
               {"umbra before", layers.first_entries, entries(EntryKind::kAbove)},
               {"umbra behind", layers.first_entries, entries(EntryKind::kBelow)}};
  const int size = layers.size;
  std::vector<TexturePicture> pictures;
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  std::vector<float> depths(numbers.size());
  for (const auto& each : shown) {
    gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, each.from.id.texture, 0, each.layer);
    gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, each.from.depth.texture, 0, each.layer);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.ReadPixels(0, 0, size, size, GL_RED_INTEGER, GL_UNSIGNED_INT, numbers.data());
    gl.ReadPixels(0, 0, size, size, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    // The first surface is not drawn for every option.
    if (std::ranges::all_of(numbers, [](std::uint32_t number) { return number == 0; })) continue;
    TexturePicture picture{each.name, size, {}};
    for (const std::uint32_t number : numbers) picture.values.push_back(gray_of(number));
    pictures.push_back(std::move(picture));
    pictures.push_back({"its depth", size, grays_of(numbers, depths)});
  }
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
  gl::require_no_error(gl, "reading the D-buffer");
  return pictures;
}

}  // namespace penumbra::detail
