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

/// Kinds of entries, each with a layer for every target.
enum class EntryKind {
  kPenumbra,  ///< penumbra entries in front of the first surface
  kAbove,     ///< umbra entries in front of the last surface
  kBelow,     ///< umbra entries behind the last surface
};
inline constexpr int kEntryKinds = 3;

struct DBufferLayers {
  DBufferLayers(const gl::Functions& gl, int size_, int count_, int entries_)
      : size(size_),
        count(count_),
        entries(entries_),
        occluder(gl, size_, count_),
        last(gl, GL_DEPTH_COMPONENT32F, size_, count_),
        first_entries(gl, size_, kEntryKinds * count_),
        second_entries(gl, entries_ > 1 ? size_ : 1, kEntryKinds * count_) {}
  /// The layer of `first_entries` and `second_entries` for one kind and target.
  int layer_of(EntryKind kind, int target) const { return static_cast<int>(kind) * count + target; }

  int size, count, entries;
  Layer occluder;  ///< the first surface that the light's center sees
  Layers last;     ///< depth of the last surface that faces it
  Layer first_entries;
  Layer second_entries;  ///< where only one is kept: a single texel that is never read

  std::size_t bytes() const {
    const auto texels =
        static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * static_cast<std::size_t>(count);
    return texels * (8 + 4 + 3 * 8 * static_cast<std::size_t>(entries));
  }
};

}  // namespace penumbra::detail
