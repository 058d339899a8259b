// The textures of a D-buffer: what every texel of every target keeps.
//
// "Umbra and penumbra volumes" (2004), section 3.1, with an edge in place of distances. Depths are heights
// towards the light, in units that depend on the target (DBufferView::depth_scale): 0 is lowest, greater is
// nearer to the light.
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

/// A number and a depth a texel. The number is 1 + that of a face or of a facet (0: none), or, of entries
/// with DBufferContents::kDistances, the bits of the height of the edge.
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

  /// Texels a side, targets, entries kept per texel and kind.
  int size, count, entries;
  /// The first surface that the light's center sees.
  Layer occluder;
  /// Depth of the last surface that faces the light's center.
  Layers last;
  /// The nearest entries (or the furthest, as Conflict says).
  Layer first_entries;
  /// The second nearest. Where only one is kept, a single texel that is never read.
  Layer second_entries;

  std::size_t bytes() const {
    const auto texels =
        static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * static_cast<std::size_t>(count);
    return texels * (8 + 4 + 3 * 8 * static_cast<std::size_t>(entries));
  }
};

}  // namespace penumbra::detail
