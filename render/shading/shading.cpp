#include "render/shading/shading.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "mesh/vectors.h"
#include "render/light/light_factors.h"
#include "render/light/light_integrals.h"
#include "render/shading/fill_and_fade.h"

namespace penumbra {
namespace {

using detail::LightFactors;

constexpr double kPi = std::numbers::pi;

/// What one light gives a pixel.
struct Lit {
  /// Irradiance.
  Vec3 with_shadow, without;
};

struct ShadedLight {
  AreaLight light;
  Vec3 radiance;
  std::span<const float> visibility;

  ShadedLight(const Light& of, const LightVisibility& seen)
      : light(area_light(of.shape)), radiance(of.radiance), visibility(seen.visibility) {}

  /// The fraction that pixel i sees of the part of the light above its horizon.
  double share(std::size_t i, double above) const {
    return above > 0.0 ? std::min(1.0, static_cast<double>(visibility[i]) / above) : 0.0;
  }
  /// Of pixel i, for a normal to shade with.
  Lit at(std::size_t i, const LightFactors::Factors& flat, const Vec3& point, const Vec3& normal,
         const Vec3& smooth) const {
    const double factor = smooth == normal
                              ? flat.irradiance
                              : smooth_factor(point, smooth, glm::dot(smooth, normal), flat.irradiance);
    return {radiance * (factor * share(i, flat.above)), radiance * factor};
  }

  double smooth_factor(const Vec3& point, const Vec3& smooth, double cosine, double flat) const {
    const double factor = irradiance_factor(light, to_light_frame(light, point, smooth));
    if (!(factor > 0.0)) return 0.0;
    const double ratio = std::min(1.0, flat / (factor * cosine));
    return factor * ratio * (1.0 + ratio * (1.0 - ratio));
  }
};

/// The normal between those of the face's corners, on the side of the flat one; that where the object has
/// none.
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

/// An object as a picture shows it.
struct Material {
  Vec3 albedo_over_pi;
  /// One color, flat faces, nothing but light: what most objects are.
  bool is_plain;
  /// Of an object that fades.
  Vec3 middle;

  Material(const SceneObject& object, const PictureSettings& picture)
      : albedo_over_pi(object.albedo / kPi),
        is_plain(object.face_albedo.of_face.empty() && object.corner_normals.empty() &&
                 !(object.fade.to > 0.0) && !object.shadow_catcher && picture.ambient == Vec3(0.0)),
        middle(object.fade.to > 0.0 ? object.fade.middle.value_or(object.mesh.bounds().center())
                                    : Vec3(0.0)) {}
};

using Rgba = std::array<float, 4>;

Rgba to_rgba(const Vec3& color, double alpha) {
  return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z),
          static_cast<float>(alpha)};
}

/// The scene as a picture shows it: what is the same for all pixels.
class Shader {
 public:
  Shader(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights)
      : scene_(scene), surface_(surface), up_(detail::unit(scene.camera.up)) {
    for (std::size_t k = 0; k < lights.size(); ++k)
      if (!lights[k].is_dark) lights_.emplace_back(scene.lights[k], lights[k]);
    for (const SceneObject& object : scene.objects) materials_.emplace_back(object, scene.picture);
  }

  /// Calls `visit(pixel, color, is_behind)` for each pixel, on all threads: its R G B A, and is_behind(k) for
  /// the kth light that is not dark. Of a pixel that shows no surface both are 0.
  template <class Visit>
  void for_each_pixel(const detail::Threads& threads, const Visit& visit) const {
    constexpr std::size_t kBlock = LightFactors::kMost;
    const std::size_t size = surface_.size();
    threads->execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, (size + kBlock - 1) / kBlock, 32), [&](const auto& range) {
            std::vector<LightFactors> factors(lights_.size());
            for (std::size_t block = range.begin(); block < range.end(); ++block)
              shade_block(block * kBlock, std::min(kBlock, size - block * kBlock), factors, visit);
          });
    });
  }

 private:
  template <class Visit>
  void shade_block(std::size_t first, std::size_t count, std::vector<LightFactors>& factors,
                   const Visit& visit) const {
    for (std::size_t k = 0; k < lights_.size(); ++k)
      factors[k].find(lights_[k].light, &surface_.position[first], &surface_.normal[first], count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t pixel = first + i;
      if (!surface_.hit(pixel)) {
        visit(pixel, Rgba{}, [](std::size_t) { return false; });
        continue;
      }
      const Material& material = materials_[static_cast<std::size_t>(surface_.object[pixel])];
      visit(pixel, material.is_plain ? plain_color(pixel, i, material, factors) : color_of(pixel, i, factors),
            [&](std::size_t k) { return factors[k].is_behind(i); });
    }
  }

  Rgba plain_color(std::size_t pixel, std::size_t i, const Material& material,
                   const std::vector<LightFactors>& factors) const {
    Vec3 color(0.0);
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      if (lights_[k].visibility[pixel] == 0.0f) continue;
      const LightFactors::Factors f = factors[k].at(i);
      color +=
          material.albedo_over_pi * (lights_[k].radiance * (f.irradiance * lights_[k].share(pixel, f.above)));
    }
    return to_rgba(color, 1.0);
  }

  Rgba color_of(std::size_t pixel, std::size_t i, const std::vector<LightFactors>& factors) const {
    const auto index = static_cast<std::size_t>(surface_.object[pixel]);
    const SceneObject& seen = scene_.objects[index];
    const Vec3 &point = surface_.position[pixel], &normal = surface_.normal[pixel];
    const Vec3 albedo = seen.albedo_of(surface_.face[pixel]);
    const Vec3 smooth = smooth_normal(seen, surface_.face[pixel], point, normal);
    Vec3 color(0.0), without(0.0);
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      const Lit lit = lights_[k].at(pixel, factors[k].at(i), point, normal, smooth);
      color += albedo / kPi * lit.with_shadow;
      without += albedo / kPi * lit.without;
    }
    if (scene_.picture.ambient != Vec3(0.0)) {
      const Vec3 fill = albedo * scene_.picture.ambient * detail::sky_factor(smooth, up_);
      color += fill;
      without += fill;
    }
    double alpha = detail::opacity_at(seen.fade, materials_[index].middle, point);
    if (seen.shadow_catcher) {
      alpha *= detail::catcher_opacity(color, without);
      color = Vec3(0.0);
    }
    return to_rgba(color * alpha, alpha);
  }

  const Scene& scene_;
  const SurfaceBuffer& surface_;
  Vec3 up_;
  /// All that are not dark.
  std::vector<ShadedLight> lights_;
  /// One an object.
  std::vector<Material> materials_;
};

/// Channels of an image, made where they are missing. Their memory is taken on all threads: the system clears
/// it, which takes as long as filling it.
class Channels {
 public:
  explicit Channels(Image& image) : image_(image) {}

  float* operator[](const std::string& name) { return image_.channels.at(name).data(); }
  void make(const std::vector<std::string>& names, const detail::Threads& threads) {
    const std::size_t size = static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height);
    std::vector<std::vector<float>*> missing;
    for (const std::string& name : names)
      if (std::vector<float>& channel = image_.channels[name]; channel.size() != size)
        missing.push_back(&channel);
    threads->execute([&] {
      tbb::parallel_for(std::size_t{0}, missing.size(),
                        [&](std::size_t k) { missing[k]->assign(size, 0.0f); });
    });
  }
  void drop_all_but(const std::vector<std::string>& some, const std::vector<std::string>& others) {
    const auto is_in = [](const auto& names, const std::string& name) {
      return std::ranges::find(names, name) != names.end();
    };
    std::erase_if(image_.channels, [&](const auto& channel) {
      return !is_in(some, channel.first) && !is_in(others, channel.first);
    });
  }

 private:
  Image& image_;
};

/// Where a light's channels are written.
struct LightChannels {
  std::span<const std::int8_t> seen_region;
  std::span<const float> seen;
  float *visibility, *region;

  void write(std::size_t i, bool is_behind) const {
    visibility[i] = seen[i];
    region[i] = is_behind ? 2.0f : (seen_region.empty() ? -1.0f : static_cast<float>(seen_region[i]));
  }
  void write_none(std::size_t i) const {
    visibility[i] = 1.0f;
    region[i] = -1.0f;
  }
};

std::string channel_of(const Scene& scene, std::size_t light, const char* name) {
  return scene.lights.size() > 1 ? std::string(name) + "." + scene.lights[light].name : name;
}

const std::vector<std::string> kSurfaceChannels{"object", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"};

void write_surface(const SurfaceBuffer& surface, const detail::Threads& threads, Channels& channels) {
  channels.make(kSurfaceChannels, threads);
  float* object = channels["object"];
  float* position[3] = {channels["P.X"], channels["P.Y"], channels["P.Z"]};
  float* normal[3] = {channels["N.X"], channels["N.Y"], channels["N.Z"]};
  threads->execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        object[i] = static_cast<float>(surface.object[i]);
        const bool hit = surface.hit(i);
        for (int k = 0; k < 3; ++k) {
          position[k][i] = hit ? static_cast<float>(surface.position[i][k]) : 0.0f;
          normal[k][i] = hit ? static_cast<float>(surface.normal[i][k]) : 0.0f;
        }
      }
    });
  });
}

}  // namespace

Image shade(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
            const detail::Threads& threads) {
  Image image;
  shade(scene, surface, lights, threads, {}, image);
  return image;
}

void shade(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
           const detail::Threads& threads, const ShadeOptions& options, Image& image) {
  image.width = surface.width;
  image.height = surface.height;
  Channels channels(image);
  if (!options.has_surface) write_surface(surface, threads, channels);
  std::vector<std::string> kept{"R", "G", "B", "A"};
  for (std::size_t k = 0; k < lights.size(); ++k)
    if (!lights[k].is_dark || !options.leave_out_dark)
      for (const char* name : {"visibility", "region"}) kept.push_back(channel_of(scene, k, name));
  channels.make(kept, threads);
  channels.drop_all_but(kept, kSurfaceChannels);
  float* rgba[4] = {channels["R"], channels["G"], channels["B"], channels["A"]};
  std::vector<LightChannels> of_lights;
  for (std::size_t k = 0; k < lights.size(); ++k)
    if (!lights[k].is_dark)
      of_lights.push_back({lights[k].region, lights[k].visibility,
                           channels[channel_of(scene, k, "visibility")],
                           channels[channel_of(scene, k, "region")]});
  const Shader shader(scene, surface, lights);
  shader.for_each_pixel(threads, [&](std::size_t i, const Rgba& color, const auto& is_behind) {
    for (std::size_t k = 0; k < 4; ++k) rgba[k][i] = color[k];
    for (std::size_t k = 0; k < of_lights.size(); ++k)
      if (surface.hit(i))
        of_lights[k].write(i, is_behind(k));
      else
        of_lights[k].write_none(i);
  });
  if (!options.leave_out_dark) detail::add_dark_channels(scene, surface, lights, threads, image);
}

void detail::add_dark_channels(const Scene& scene, const SurfaceBuffer& surface,
                               std::span<const LightVisibility> lights, const Threads& threads,
                               Image& image) {
  Channels channels(image);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    if (!lights[k].is_dark) continue;
    const std::string visibility = channel_of(scene, k, "visibility"),
                      region = channel_of(scene, k, "region");
    channels.make({visibility, region}, threads);
    const AreaLight light = area_light(scene.lights[k].shape);
    float *seen = channels[visibility], *certified = channels[region];
    threads->execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const bool hit = surface.hit(i);
          seen[i] = hit ? 0.0f : 1.0f;
          certified[i] = hit && light.is_behind(surface.position[i]) ? 2.0f : -1.0f;
        }
      });
    });
  }
}

Colors shade_colors(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
                    const detail::Threads& threads) {
  Colors out;
  std::vector<float>* const channels[4] = {&out.r, &out.g, &out.b, &out.a};
  for (std::vector<float>* channel : channels) channel->resize(surface.size());
  const Shader shader(scene, surface, lights);
  shader.for_each_pixel(threads, [&](std::size_t i, const Rgba& color, const auto&) {
    for (std::size_t k = 0; k < 4; ++k) (*channels[k])[i] = color[k];
  });
  return out;
}

}  // namespace penumbra
