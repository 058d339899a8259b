// An 8-bit picture as a texture of the window's context, shown pixel for pixel.
#pragma once

#include <vector>

#include "render/gl/program.h"

namespace penumbra::viewer {

/// 8-bit sRGB, row 0 at the top; empty: nothing to show.
struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

class PictureTexture {
 public:
  explicit PictureTexture(const gl::Functions& functions);
  /// `smooth`: pixels of the picture run into each other where it is shown larger than it is.
  void upload(const Pixels& pixels, bool smooth = false);
  /// What ImGui calls a texture.
  void* id() const;
  bool empty() const { return empty_; }

 private:
  const gl::Functions& gl_;
  gl::Object texture_;
  bool empty_ = true;
};

}  // namespace penumbra::viewer
