// The D-buffer's textures.
#pragma once

#include "render/gl/program.h"

namespace penumbra::detail {

/// A layered texture, one layer a target.
struct Layers {
  Layers(const gl::Functions& gl, GLenum format, int size, int count)
      : texture(gl, gl::Object::Kind::kTexture) {
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    gl.TexStorage3D(GL_TEXTURE_2D_ARRAY, 1, format, size, size, count);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  gl::Object texture;
};

/// A number and a depth a texel: the occluder's face, or an entry.
struct Layer {
  Layer(const gl::Functions& gl, int size, int count)
      : id(gl, GL_R32UI, size, count), depth(gl, GL_DEPTH_COMPONENT32F, size, count) {}
  Layers id, depth;
};

/// First and, where two entries are kept, second entries of one kind. With one entry the second is a single
/// texel that is never read.
struct EntryLayers {
  EntryLayers(const gl::Functions& gl, int size, int count, int entries)
      : first(gl, size, count), second(gl, entries > 1 ? size : 1, count) {}
  Layer first, second;
};

struct DBufferLayers {
  DBufferLayers(const gl::Functions& gl, int size_, int count_, int entries_)
      : size(size_),
        count(count_),
        entries(entries_),
        occluder(gl, size_, count_),
        last(gl, GL_DEPTH_COMPONENT32F, size_, count_),
        penumbra(gl, size_, count_, entries_),
        above(gl, size_, count_, entries_),
        below(gl, size_, count_, entries_) {}
  int size, count, entries;
  Layer occluder;        ///< the first surface that the light's center sees
  Layers last;           ///< depth of the last surface that faces it
  EntryLayers penumbra;  ///< penumbra entries in front of the first surface
  EntryLayers above;     ///< umbra entries in front of the last surface
  EntryLayers below;     ///< umbra entries behind the last surface

  std::size_t bytes() const {
    const auto texels =
        static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * static_cast<std::size_t>(count);
    return texels * (8 + 4 + 3 * 8 * static_cast<std::size_t>(entries));
  }
};

}  // namespace penumbra::detail
