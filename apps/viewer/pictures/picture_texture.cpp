#include "apps/viewer/pictures/picture_texture.h"

#include <cstdint>

namespace penumbra::viewer {

PictureTexture::PictureTexture(const gl::Functions& functions)
    : gl_(functions), texture_(functions, gl::Object::Kind::kTexture) {
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void PictureTexture::upload(const Pixels& pixels, bool smooth) {
  empty_ = pixels.rgb.empty();
  if (empty_) return;
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, pixels.width, pixels.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 pixels.rgb.data());
}

void* PictureTexture::id() const {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(static_cast<GLuint>(texture_)));
}

}  // namespace penumbra::viewer
