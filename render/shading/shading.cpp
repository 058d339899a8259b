#include "render/shading/shading.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"
#include "render/light/light_integrals.h"

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

/// One light, and where its channels are written.
struct LitChannels {
  AreaLight light;
  Vec3 radiance;
  LightVisibility seen;
  float *visibility, *region;

  LitChannels(const Light& of, const LightVisibility& seen_, const std::string& suffix, Image& image)
      : light(area_light(of.shape)),
        radiance(of.radiance),
        seen(seen_),
        visibility(image.add("visibility" + suffix, 1.0f).data()),
        region(image.add("region" + suffix, -1.0f).data()) {}

  /// Writes pixel i; returns its irradiance. `smooth` is the normal to shade with.
  Vec3 write(std::size_t i, const Vec3& point, const Vec3& normal, const Vec3& smooth) const {
    const InLightFrame p = to_light_frame(light, point, normal);
    const double above = fraction_above_horizon(light, p);
    const double share = above > 0.0 ? std::min(1.0, static_cast<double>(seen.visibility[i]) / above) : 0.0;
    visibility[i] = seen.visibility[i];
    region[i] = p.x.z <= 0.0 ? 2.0f : (seen.region.empty() ? -1.0f : static_cast<float>(seen.region[i]));
    const double flat = irradiance_factor(light, p);
    return radiance *
           ((smooth == normal ? flat : smooth_factor(point, smooth, glm::dot(smooth, normal), flat)) * share);
  }

  double smooth_factor(const Vec3& point, const Vec3& smooth, double cosine, double flat) const {
    const double factor = irradiance_factor(light, to_light_frame(light, point, smooth));
    if (!(factor > 0.0)) return 0.0;
    const double ratio = std::min(1.0, flat / (factor * cosine));
    return factor * ratio * (1.0 + ratio * (1.0 - ratio));
  }
};

/// The normal between those of the face's corners, on the side of the flat one; that where the object has none.
Vec3 smooth_normal(const SceneObject& object, std::uint32_t face, const Vec3& point, const Vec3& flat) {
  if (face >= object.corner_normals.size()) return flat;
  const auto& [i, j, k] = object.mesh.triangles()[face];
  const std::span<const Vec3> positions = object.mesh.positions();
  const Vec3 &a = positions[i], &b = positions[j], &c = positions[k];
  const double scale = 1.0 / std::max(detail::largest_component(b - a), detail::largest_component(c - a));
  const Vec3 u = (b - a) * scale, v = (c - a) * scale, w = (point - a) * scale, n = glm::cross(u, v);
  const double at_b = std::clamp(glm::dot(glm::cross(w, v), n) / glm::dot(n, n), 0.0, 1.0);
  const double at_c = std::clamp(glm::dot(glm::cross(u, w), n) / glm::dot(n, n), 0.0, 1.0 - at_b);
  const auto& [na, nb, nc] = object.corner_normals[face];
  const Vec3 smooth = detail::unit((1.0 - at_b - at_c) * Vec3(na) + at_b * Vec3(nb) + at_c * Vec3(nc));
  const double side = glm::dot(smooth, flat);
  if (side == 0.0 || side != side) return flat;
  return side > 0.0 ? smooth : -smooth;
}

}  // namespace

Image shade(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
            const detail::Threads& threads) {
  Image image;
  image.width = surface.width;
  image.height = surface.height;
  float* rgb[3] = {image.add("R").data(), image.add("G").data(), image.add("B").data()};
  float* alpha = image.add("A").data();
  float* object = image.add("object", -1.0f).data();
  float* position[3] = {image.add("P.X").data(), image.add("P.Y").data(), image.add("P.Z").data()};
  float* normal[3] = {image.add("N.X").data(), image.add("N.Y").data(), image.add("N.Z").data()};
  std::vector<LitChannels> channels;
  for (std::size_t k = 0; k < lights.size(); ++k)
    channels.emplace_back(scene.lights[k], lights[k], lights.size() > 1 ? "." + scene.lights[k].name : "",
                          image);
  const auto shade_pixel = [&](std::size_t i) {
    if (!surface.hit(i)) return;
    const SceneObject& seen = scene.objects[static_cast<std::size_t>(surface.object[i])];
    const Vec3 albedo = seen.albedo_of(surface.face[i]);
    const Vec3 smooth = smooth_normal(seen, surface.face[i], surface.position[i], surface.normal[i]);
    Vec3 color(0.0);
    for (const LitChannels& light : channels)
      color += albedo / kPi * light.write(i, surface.position[i], surface.normal[i], smooth);
    for (int k = 0; k < 3; ++k) {
      rgb[k][i] = static_cast<float>(color[k]);
      position[k][i] = static_cast<float>(surface.position[i][k]);
      normal[k][i] = static_cast<float>(surface.normal[i][k]);
    }
    alpha[i] = 1.0f;
    object[i] = static_cast<float>(surface.object[i]);
  };
  threads->execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) shade_pixel(i);
    });
  });
  return image;
}

}  // namespace penumbra
