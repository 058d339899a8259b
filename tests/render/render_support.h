// What the render tests share: scenes of data/scenes, receivers placed by hand, rays in double, random
// numbers.
#pragma once

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "penumbra/mesh/shapes.h"
#include "penumbra/render/scene/scene.h"
#include "penumbra/render/support/counts.h"
#include "render/light/disk_area.h"
#include "render/rays/camera_rays.h"
#include "render/rays/reference.h"
#include "tests/render/visibility_support.h"

namespace penumbra::testing {

using Values = std::vector<float>;
using Pixels = std::vector<std::uint32_t>;

inline constexpr double kPi = std::numbers::pi;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// Logarithms evenly spread.
  double spread(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Vec3 point(double size = 1.0) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = point();
      if (const double length = glm::length(v); length > 0.1 && length < 1.0) return v / length;
    }
  }
  glm::dvec2 unit2() {
    const double angle = uniform(0.0, 2.0 * kPi);
    return {std::cos(angle), std::sin(angle)};
  }

 private:
  std::mt19937_64 engine_;
};

inline Scene data_scene(const std::string& name) {
  return load_scene(std::filesystem::path(PENUMBRA_DATA) / "scenes" / (name + ".json")).scene;
}

/// A scene with the light's frame for a world: disk in z = 0 about the origin, light towards +z.
inline Scene scene_in_light_frame(double radius, std::vector<TriangleMesh> casters) {
  Scene scene;
  testing::light_of(scene) = {Vec3(0.0), Vec3(0, 0, 1), radius};
  for (TriangleMesh& mesh : casters) scene.objects.push_back({"caster", std::move(mesh), Vec3(0.8), true});
  return scene;
}

inline TriangleMesh mesh_of(const std::vector<Vec3>& positions,
                            const std::vector<IndexedTriangle>& triangles) {
  return TriangleMesh::build(positions, triangles);
}

/// A rectangle in a plane z = const.
inline TriangleMesh rectangle(double x0, double x1, double y0, double y1, double z) {
  return mesh_of({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2}, {0, 2, 3}});
}

/// Receivers that belong to no mesh: `object` 0, a face that no caster has.
inline SurfaceBuffer receivers(const std::vector<Vec3>& positions, const std::vector<Vec3>& normals,
                               int width) {
  SurfaceBuffer s;
  s.width = width;
  s.height = static_cast<int>(positions.size()) / width;
  s.object.assign(positions.size(), 0);
  s.face.assign(positions.size(), 1u << 20);
  s.position = positions;
  s.normal = normals;
  return s;
}

inline SurfaceBuffer receivers(const std::vector<Vec3>& positions, const Vec3& normal, int width) {
  return receivers(positions, std::vector<Vec3>(positions.size(), normal), width);
}

/// 0, 1, …, count - 1.
inline Pixels first_pixels(std::size_t count) {
  Pixels pixels(count);
  std::iota(pixels.begin(), pixels.end(), 0u);
  return pixels;
}
inline Pixels every_pixel(const SurfaceBuffer& surface) {
  return first_pixels(surface.size());
}

inline Pixels pixels_of(const SurfaceBuffer& surface, int object) {
  Pixels pixels;
  for (std::uint32_t i = 0; i < surface.size(); ++i)
    if (surface.object[i] == object) pixels.push_back(i);
  return pixels;
}

/// A frame's count that is an integer; an exception for one that is missing or not an integer.
inline std::uint64_t count_in(const Counts& counts, std::string_view name) {
  const Count* count = find(counts, name);
  if (!count) throw std::out_of_range("no count " + std::string(name));
  return std::get<std::uint64_t>(count->value);
}

/// A scene as the camera sees it, with references traced only where penumbra may be.
class View {
 public:
  View(const Scene& scene_, int width, int height, int threads = 0)
      : scene(scene_),
        rays(scene_, threads),
        surface(make_surface_buffer(scene_, rays, width, height)),
        hierarchies_(scene_) {}

  Values trace(const Pixels& pixels, int samples, std::uint64_t seed) const {
    return trace_reference(rays, scene.lights.front().shape, surface.receivers(), pixels,
                           {.samples = samples, .seed = seed})
        .visibility;
  }
  /// Under the scene's first light, which may have changed; hierarchies over edges are made once.
  SilhouetteResult see_silhouettes(const SilhouetteOptions& options = {},
                                   const Progress& progress = {}) const {
    return silhouette_visibility(scene, rays, hierarchies_, light_of(scene), surface.receivers(), options,
                                 progress);
  }
  /// Pixels of `pixels` within two of one that 64 samples find partly lit.
  Pixels near_penumbra(const Pixels& pixels) const {
    const Values v = trace(every_pixel(surface), 64, 777);
    std::vector<bool> near(surface.size(), false);
    for (int y = 0; y < surface.height; ++y)
      for (int x = 0; x < surface.width; ++x)
        if (const float f = v[at(x, y)]; f > 0.0f && f < 1.0f) mark(near, x, y);
    Pixels out;
    std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(out),
                 [&](std::uint32_t i) { return near[i]; });
    return out;
  }

  const Scene& scene;
  RayScene rays;
  SurfaceBuffer surface;

 private:
  mutable detail::EdgeHierarchies hierarchies_;

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(surface.width) +
           static_cast<std::size_t>(x);
  }
  void mark(std::vector<bool>& near, int x, int y) const {
    for (int j = std::max(0, y - 2); j <= std::min(surface.height - 1, y + 2); ++j)
      for (int i = std::max(0, x - 2); i <= std::min(surface.width - 1, x + 2); ++i) near[at(i, j)] = true;
  }
};

/// The values of an image at the pixels listed.
inline Values at_pixels(const Values& image, const Pixels& pixels) {
  Values out;
  for (const std::uint32_t i : pixels) out.push_back(image[i]);
  return out;
}

inline double rms_difference(std::span<const float> values, std::span<const double> truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += (values[i] - truth[i]) * (values[i] - truth[i]);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Where the segment from x to p meets a triangle, in double: its parameter in (0, 1), else 2. `margin`: the
/// smallest barycentric coordinate, how clearly it hits (negative: by how much it misses).
struct SegmentHit {
  double at = 2.0, margin = -1.0;
};
inline SegmentHit segment_triangle(const Vec3& x, const Vec3& p, const Vec3& a, const Vec3& b,
                                   const Vec3& c) {
  const Vec3 d = p - x, e1 = b - a, e2 = c - a, h = glm::cross(d, e2);
  const double det = glm::dot(e1, h);
  if (det == 0.0) return {};
  const Vec3 s = x - a, q = glm::cross(s, e1);
  const double u = glm::dot(s, h) / det, v = glm::dot(d, q) / det, t = glm::dot(e2, q) / det;
  if (!(t > 0.0 && t < 1.0)) return {};
  return {t, std::min({u, v, 1.0 - u - v})};
}

/// Whether a caster hides p from x, which lies on one of its faces or on none, and whether that is clear (no
/// triangle's border within `margin` of the segment).
struct Blocked {
  bool hidden = false, clear = true;
};
inline Blocked is_blocked(const Scene& scene, const Vec3& x, const Vec3& p, double margin = 1e-5,
                          std::int32_t own_object = -1, std::uint32_t own_face = 0) {
  Blocked out;
  for (const SceneObject& object : scene.objects) {
    if (!object.casts) continue;
    const auto points = object.mesh.positions();
    for (const IndexedTriangle& t : object.mesh.triangles()) {
      if (own_object >= 0 && &object == &scene.objects[static_cast<std::size_t>(own_object)] &&
          &t == &object.mesh.triangles()[own_face])
        continue;
      const SegmentHit hit = segment_triangle(x, p, points[t[0]], points[t[1]], points[t[2]]);
      if (hit.at > 1.0) continue;
      out.hidden = out.hidden || hit.margin >= 0.0;
      out.clear = out.clear && std::abs(hit.margin) > margin;
    }
  }
  return out;
}

}  // namespace penumbra::testing
