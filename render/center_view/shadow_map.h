// Methods with a shadow map of the light's center: what the light's center sees of the casters first, as
// heights.
//
// The map is made in the coordinates (q, h) of a LightProjection: lines and planes stay what they are, so
// that a face is filled between its corners by a plane, and every light is a distant one. It is filled on the
// processor, by texels' centers.
//
// L. Williams, "Casting curved shadows on curved surfaces" (1978).
#pragma once

#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>

#include "penumbra/render/scene/scene.h"
#include "penumbra/render/support/texture_picture.h"
#include "render/light/light_projection.h"

namespace penumbra::detail {

/// A rectangle of places q.
struct MapWindow {
  glm::dvec2 low{1e300}, high{-1e300};
  bool empty() const { return !(low.x < high.x && low.y < high.y); }
  bool holds(const glm::dvec2& q) const {
    return q.x >= low.x && q.y >= low.y && q.x <= high.x && q.y <= high.y;
  }
  void add(const glm::dvec2& q);
};

/// Accuracy. Casters nearer to the light than this, over the depth of the projection's origin, are cut off.
inline constexpr double kLeastWeight = 0x1p-10;

/// Where the casters in front of the light are.
struct CasterReach {
  MapWindow window;
  /// The greatest height, and the least.
  double top = -1e300, bottom = 1e300;
};
CasterReach reach_of_casters(const Scene& scene, const LightProjection& projection);

/// Which objects a map shows.
enum class Drawn { kCasters, kAll };

/// Texels of a map, from first to end.
struct TexelRange {
  int first_x, end_x, first_y, end_y;
};

class ShadowMap {
 public:
  /// `size` texels a side. Cost O(faces + texels that they cover), on all threads of the arena. The result
  /// does not depend on their number. With `above`, a map of the same window and size, only what is lower
  /// than its heights is drawn: the next surface.
  ShadowMap(const Scene& scene, const LightProjection& projection, const MapWindow& window, int size,
            tbb::task_arena& threads, Drawn drawn = Drawn::kCasters, const ShadowMap* above = nullptr);
  /// Puts a height where no face is. Not while another thread uses the map.
  void raise_empty(const glm::dvec2& q, double height);

  /// What height() gives where no caster is, and beside the window.
  static constexpr float kNothing = -3.4e38f;
  /// Of the first face at the texel of a place.
  float height(const glm::dvec2& q) const {
    const glm::dvec2 p = texels_to(q);
    if (!(p.x >= 0.0 && p.y >= 0.0 && p.x < size_ && p.y < size_)) return kNothing;
    return at(static_cast<int>(p.x), static_cast<int>(p.y));
  }
  /// Of the first face at a texel, 0 to size() - 1.
  float at(int x, int y) const {
    return decoded(
        texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x)]);
  }
  int size() const { return size_; }
  std::size_t texels() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }
  /// Texels whose centers lie in a rectangle, cut to the map.
  TexelRange texels_in(const glm::dvec2& low, const glm::dvec2& high) const;
  /// A place in texels from the map's corner.
  glm::dvec2 texels_to(const glm::dvec2& q) const { return (q - window_.low) * per_texel_; }
  /// The place of a texel's center.
  glm::dvec2 center_of(int x, int y) const { return window_.low + (glm::dvec2(x, y) + 0.5) / per_texel_; }
  /// The place of a texel's lower left corner.
  glm::dvec2 corner_of(double x, double y) const { return window_.low + glm::dvec2(x, y) / per_texel_; }
  /// Texels in one unit of q.
  const glm::dvec2& per_texel() const { return per_texel_; }
  /// The larger side of a texel.
  double texel() const;
  TexturePicture picture() const;

 private:
  /// Greater heights are greater numbers; 0: nothing.
  static std::uint32_t encoded(float height);
  static float decoded(std::uint32_t code);
  void fill(const glm::dvec2* q, const double* h);
  void fill_mesh(const TriangleMesh& mesh, const LightProjection& projection);
  void raise(std::size_t texel, float height);

  /// Accuracy. Lower by less than this much of a texel is the same surface, whose faces were rounded.
  static constexpr double kSameSurface = 0.01;

  MapWindow window_;
  int size_;
  /// While it is made.
  const ShadowMap* above_;
  glm::dvec2 per_texel_;
  std::unique_ptr<std::uint32_t[]> texels_;
};

}  // namespace penumbra::detail
