#include "render/shading/shading.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numbers>

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

  /// Writes pixel i; returns its irradiance.
  Vec3 write(std::size_t i, const Vec3& point, const Vec3& normal) const {
    const InLightFrame p = to_light_frame(light, point, normal);
    const double above = fraction_above_horizon(light, p);
    const double share = above > 0.0 ? std::min(1.0, static_cast<double>(seen.visibility[i]) / above) : 0.0;
    visibility[i] = seen.visibility[i];
    region[i] = p.x.z <= 0.0 ? 2.0f : (seen.region.empty() ? -1.0f : static_cast<float>(seen.region[i]));
    return radiance * (irradiance_factor(light, p) * share);
  }
};

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
    const Vec3& albedo =
        scene.objects[static_cast<std::size_t>(surface.object[i])].albedo_of(surface.face[i]);
    Vec3 color(0.0);
    for (const LitChannels& light : channels)
      color += albedo / kPi * light.write(i, surface.position[i], surface.normal[i]);
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
