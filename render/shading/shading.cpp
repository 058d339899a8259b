#include "render/shading/shading.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"
#include "render/light/light_integrals.h"
#include "render/shading/fill_and_fade.h"

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

/// What one light gives a pixel.
struct Lit {
  /// Irradiance.
  Vec3 with_shadow, without;
  bool is_behind;
};

struct ShadedLight {
  AreaLight light;
  Vec3 radiance;
  LightVisibility seen;

  ShadedLight(const Light& of, const LightVisibility& seen_)
      : light(area_light(of.shape)), radiance(of.radiance), seen(seen_) {}

  /// Of pixel i. `smooth` is the normal to shade with.
  Lit at(std::size_t i, const Vec3& point, const Vec3& normal, const Vec3& smooth) const {
    const InLightFrame p = to_light_frame(light, point, normal);
    const double above = fraction_above_horizon(light, p);
    const double share = above > 0.0 ? std::min(1.0, static_cast<double>(seen.visibility[i]) / above) : 0.0;
    const double flat = irradiance_factor(light, p);
    const double factor =
        smooth == normal ? flat : smooth_factor(point, smooth, glm::dot(smooth, normal), flat);
    return {radiance * (factor * share), radiance * factor, p.x.z <= 0.0};
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

/// The scene as a picture shows it: what is the same for all pixels.
class Shader {
 public:
  Shader(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights)
      : scene_(scene), surface_(surface), up_(detail::unit(scene.camera.up)) {
    for (std::size_t k = 0; k < lights.size(); ++k) lights_.emplace_back(scene.lights[k], lights[k]);
    for (const SceneObject& object : scene.objects)
      middles_.push_back(object.fade.to > 0.0 ? object.mesh.bounds().center() : Vec3(0.0));
  }

  /// R G B A of pixel i, which shows a surface. `each` is told what every light gives: each(k, Lit).
  template <class Each>
  std::array<float, 4> color_of(std::size_t i, const Each& each) const {
    const auto index = static_cast<std::size_t>(surface_.object[i]);
    const SceneObject& seen = scene_.objects[index];
    const Vec3 &point = surface_.position[i], &normal = surface_.normal[i];
    const Vec3 albedo = seen.albedo_of(surface_.face[i]);
    const Vec3 smooth = smooth_normal(seen, surface_.face[i], point, normal);
    Vec3 color(0.0), without(0.0);
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      const Lit lit = lights_[k].at(i, point, normal, smooth);
      color += albedo / kPi * lit.with_shadow;
      without += albedo / kPi * lit.without;
      each(k, lit);
    }
    if (scene_.picture.ambient != Vec3(0.0)) {
      const Vec3 fill = albedo * scene_.picture.ambient * detail::sky_factor(smooth, up_);
      color += fill;
      without += fill;
    }
    double alpha = detail::opacity_at(seen.fade, middles_[index], point);
    if (seen.shadow_catcher) {
      alpha *= detail::catcher_opacity(color, without);
      color = Vec3(0.0);
    }
    color *= alpha;
    return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z),
            static_cast<float>(alpha)};
  }

  /// Calls `pixel` for each that shows a surface, on all threads.
  template <class Pixel>
  void for_each_pixel(const detail::Threads& threads, const Pixel& pixel) const {
    threads->execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface_.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          if (surface_.hit(i)) pixel(i);
      });
    });
  }

 private:
  const Scene& scene_;
  const SurfaceBuffer& surface_;
  Vec3 up_;
  std::vector<ShadedLight> lights_;
  /// Of objects that fade.
  std::vector<Vec3> middles_;
};

/// Where a light's channels are written.
struct LightChannels {
  std::span<const std::int8_t> seen_region;
  std::span<const float> seen;
  float *visibility, *region;

  LightChannels(const LightVisibility& of, const std::string& suffix, Image& image)
      : seen_region(of.region),
        seen(of.visibility),
        visibility(image.add("visibility" + suffix, 1.0f).data()),
        region(image.add("region" + suffix, -1.0f).data()) {}

  void write(std::size_t i, bool is_behind) const {
    visibility[i] = seen[i];
    region[i] = is_behind ? 2.0f : (seen_region.empty() ? -1.0f : static_cast<float>(seen_region[i]));
  }
};

}  // namespace

Image shade(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
            const detail::Threads& threads) {
  Image image;
  image.width = surface.width;
  image.height = surface.height;
  float* rgba[4] = {image.add("R").data(), image.add("G").data(), image.add("B").data(),
                    image.add("A").data()};
  float* object = image.add("object", -1.0f).data();
  float* position[3] = {image.add("P.X").data(), image.add("P.Y").data(), image.add("P.Z").data()};
  float* normal[3] = {image.add("N.X").data(), image.add("N.Y").data(), image.add("N.Z").data()};
  std::vector<LightChannels> channels;
  for (std::size_t k = 0; k < lights.size(); ++k)
    channels.emplace_back(lights[k], lights.size() > 1 ? "." + scene.lights[k].name : "", image);
  const Shader shader(scene, surface, lights);
  shader.for_each_pixel(threads, [&](std::size_t i) {
    const auto color =
        shader.color_of(i, [&](std::size_t k, const Lit& lit) { channels[k].write(i, lit.is_behind); });
    for (std::size_t k = 0; k < 4; ++k) rgba[k][i] = color[k];
    for (int k = 0; k < 3; ++k) {
      position[k][i] = static_cast<float>(surface.position[i][k]);
      normal[k][i] = static_cast<float>(surface.normal[i][k]);
    }
    object[i] = static_cast<float>(surface.object[i]);
  });
  return image;
}

Colors shade_colors(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
                    const detail::Threads& threads) {
  Colors out;
  std::vector<float>* const channels[4] = {&out.r, &out.g, &out.b, &out.a};
  for (std::vector<float>* channel : channels) channel->assign(surface.size(), 0.0f);
  const Shader shader(scene, surface, lights);
  shader.for_each_pixel(threads, [&](std::size_t i) {
    const auto color = shader.color_of(i, [](std::size_t, const Lit&) {});
    for (std::size_t k = 0; k < 4; ++k) (*channels[k])[i] = color[k];
  });
  return out;
}

}  // namespace penumbra
