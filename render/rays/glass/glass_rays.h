// Rays through bodies of glass: where they enter and leave.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace penumbra {

/// Where a ray's line crosses a body's surface.
struct GlassCrossing {
  /// In lengths of the ray's direction.
  double distance;
  /// Of the ray and the surface's normal, flat or smooth: the larger cosine, 0 to 1.
  double facing;
  std::uint32_t body;
  bool enters;
};

class GlassRays {
 public:
  /// Throws what RayScene does. Cost O(faces · log faces).
  explicit GlassRays(std::span<const GlassBody> bodies);
  ~GlassRays();
  GlassRays(GlassRays&&) noexcept;
  GlassRays& operator=(GlassRays&&) noexcept;

  /// All crossings in front of the origin, nearest first. Through an edge a ray crosses both faces there:
  /// that counts once. One through a vertex may miss a crossing. Single precision, in a frame around the
  /// bodies. By any number of threads at a time.
  void find_crossings(const Vec3& origin, const Vec3& direction, std::vector<GlassCrossing>& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
