#include "apps/cli/study/pictures/study_disks.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "apps/cli/study/pictures/study_pictures.h"
#include "apps/cli/study/pictures/webp.h"
#include "penumbra/render/visibility.h"

namespace penumbra::apps {
namespace {

/// Two directions across the light.
struct Axes {
  Vec3 u, v;
};
Axes axes_of(const Vec3& normal) {
  const Vec3 m = glm::normalize(normal);
  const Vec3 u = glm::normalize(glm::cross(m, std::abs(m.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  return {u, glm::cross(m, u)};
}

/// The light's point at (x, y) of the unit disk, as a light. Nothing of a rectangle.
struct PointOf {
  double x, y;

  std::optional<LightShape> operator()(const DiskLight& light) const {
    const Axes axes = axes_of(light.normal);
    return DiskLight{light.center + light.radius * (x * axes.u + y * axes.v), light.normal, 0.0};
  }
  std::optional<LightShape> operator()(const DistantLight& light) const {
    const Axes axes = axes_of(light.direction);
    const double half = std::tan(light.angle_degrees / 360.0 * std::numbers::pi);
    return DistantLight{glm::normalize(light.direction) - half * (x * axes.u + y * axes.v), 0.0};
  }
  std::optional<LightShape> operator()(const RectangleLight&) const { return std::nullopt; }
};

/// Some of a picture's pixels as receivers of their own.
struct Chosen {
  int columns = 0, rows = 0;
  std::vector<Vec3> points, normals;
  std::vector<std::int32_t> objects;
  std::vector<std::uint32_t> faces;

  Chosen(const SurfaceBuffer& surface, int step)
      : columns((surface.width + step - 1) / step), rows((surface.height + step - 1) / step) {
    for (int y = 0; y < surface.height; y += step)
      for (int x = 0; x < surface.width; x += step) {
        const auto i = static_cast<std::size_t>(y * surface.width + x);
        points.push_back(surface.position[i]);
        normals.push_back(surface.hit(i) ? surface.normal[i] : Vec3(0, 1, 0));
        objects.push_back(surface.object[i]);
        faces.push_back(surface.face[i]);
      }
  }
  Receivers receivers() const {
    return {.points = points, .normals = normals, .objects = objects, .faces = faces};
  }
};

}  // namespace

std::optional<std::string> encode_disks(const StudyCase& seen, const SurfaceBuffer& surface, int threads) {
  const Chosen chosen(surface, kDiskSpacing * thinning_of(surface.width));
  const Casters casters(seen.scene.objects, threads);
  const int width = chosen.columns * kDiskPoints, height = chosen.rows * kDiskPoints;
  std::vector<unsigned char> bytes(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int row = 0; row < kDiskPoints; ++row)
    for (int column = 0; column < kDiskPoints; ++column) {
      const auto place = [](int k) { return (2.0 * k + 1.0) / kDiskPoints - 1.0; };
      const auto light = std::visit(PointOf{place(column), -place(row)}, seen.scene.lights.front().shape);
      if (!light) return std::nullopt;
      const std::vector<float> hard =
          visibility(casters, *light, chosen.receivers(), {.method = "hard"}).visibility;
      for (std::size_t k = 0; k < hard.size(); ++k) {
        const auto columns = static_cast<std::size_t>(chosen.columns);
        const std::size_t x = k % columns * kDiskPoints + static_cast<std::size_t>(column);
        const std::size_t y = k / columns * kDiskPoints + static_cast<std::size_t>(row);
        for (std::size_t c = 0; c < 3; ++c)
          bytes[3 * (y * static_cast<std::size_t>(width) + x) + c] = hard[k] > 0.5f ? 255 : 0;
      }
    }
  return encode_webp(width, height, bytes);
}

}  // namespace penumbra::apps
