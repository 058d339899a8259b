// Whether some casting face overlaps the pyramid between a receiver and the disk: by brute force over faces,
// in double, with no edges and no silhouettes.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <random>
#include <vector>

#include "render/rays/ray_scene.h"
#include "render/silhouette/collect/light_band.h"
#include "render/silhouette/light_rays.h"
#include "render/silhouette/silhouette_visibility.h"
#include "tests/render/visibility_support.h"

namespace penumbra::testing {

class FaceOverlap {
 public:
  explicit FaceOverlap(const Scene& scene) : light_(testing::light_of(scene)) {
    for (const SceneObject& object : scene.objects) {
      if (!object.casts) continue;
      const auto p = object.mesh.positions();
      for (const IndexedTriangle& t : object.mesh.triangles())
        faces_.push_back({light_.point(p[t[0]]), light_.point(p[t[1]]), light_.point(p[t[2]])});
    }
  }
  std::size_t faces() const { return faces_.size(); }
  /// For a receiver in the world; false for one that is not in front of the light.
  bool any(const Vec3& receiver) const {
    const Vec3 x = light_.point(receiver);
    return x.z > 0.0 &&
           std::any_of(faces_.begin(), faces_.end(), [&](const Face& f) { return overlaps(f, x); });
  }

 private:
  using Face = std::array<Vec3, 3>;

  /// What of the face lies in front of the light and below x, seen from x on the plane of the disk.
  static bool overlaps(const Face& face, const Vec3& x) {
    std::vector<Vec3> corners(face.begin(), face.end());
    const double top = x.z * (1.0 - 0x1p-23);
    cut(corners, [](const Vec3& p) { return p.z; });
    cut(corners, [&](const Vec3& p) { return top - p.z; });
    bool left = !corners.empty(), right = left;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::dvec2 a = seen(corners[i], x), b = seen(corners[(i + 1) % corners.size()], x);
      if (distance2(a, b) < 1.0) return true;
      left = left && a.x * b.y - a.y * b.x > 0.0;
      right = right && a.x * b.y - a.y * b.x < 0.0;
    }
    return left || right;  // all of the disk is inside
  }

  template <class Height>
  static void cut(std::vector<Vec3>& corners, const Height& height) {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const double ha = height(a), hb = height(b);
      if (ha > 0.0) out.push_back(a);
      if ((ha > 0.0) != (hb > 0.0)) out.push_back(a + (ha / (ha - hb)) * (b - a));
    }
    corners = out;
  }

  static glm::dvec2 seen(const Vec3& p, const Vec3& x) {
    return glm::dvec2(x) + (glm::dvec2(p) - glm::dvec2(x)) * (x.z / (x.z - p.z));
  }
  /// Of the segment from the disk's center, squared.
  static double distance2(const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 s = b - a;
    const double length2 = glm::dot(s, s);
    const double t = length2 > 0.0 ? std::clamp(-glm::dot(a, s) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec2 foot = a + t * s;
    return glm::dot(foot, foot);
  }

  detail::UnitLight light_;
  std::vector<Face> faces_;
};

struct LitShare {
  double share;            ///< certified lit of what no face overlaps, -1 where nothing is free
  std::size_t tested;      ///< of the pixels without certificate, chosen by a fixed seed
  std::size_t overlapped;  ///< pixels certified lit that a face overlaps after all, of as many
};

/// At most `work` pairs of pixels and faces.
inline LitShare certified_share_of_free(const Scene& scene, const SurfaceBuffer& surface,
                                        const std::vector<std::int8_t>& region, std::size_t work) {
  const FaceOverlap faces(scene);
  std::vector<std::uint32_t> open, lit;
  for (std::uint32_t i = 0; i < region.size(); ++i)
    if (surface.hit(i) && region[i] <= 0) (region[i] == 0 ? lit : open).push_back(i);
  std::mt19937 engine(7);
  std::shuffle(open.begin(), open.end(), engine);
  std::shuffle(lit.begin(), lit.end(), engine);
  const std::size_t most = std::max<std::size_t>(200, work / std::max<std::size_t>(1, faces.faces()));
  const auto overlapped = [&](std::uint32_t i) { return faces.any(surface.position[i]); };
  const auto count = [&](const std::vector<std::uint32_t>& pixels) {
    const auto end = pixels.begin() + static_cast<std::ptrdiff_t>(std::min(most, pixels.size()));
    return static_cast<std::size_t>(std::count_if(pixels.begin(), end, overlapped));
  };
  const std::size_t tested = std::min(most, open.size()), wrong = count(lit);
  const double free =
      tested > 0 ? static_cast<double>(tested - count(open)) / static_cast<double>(tested) : 0.0;
  const double all = static_cast<double>(lit.size()) + free * static_cast<double>(open.size());
  return {all > 0.0 ? static_cast<double>(lit.size()) / all : -1.0, tested, wrong};
}

}  // namespace penumbra::testing
