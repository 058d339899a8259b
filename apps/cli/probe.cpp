#include "apps/cli/probe.h"

#include <array>

#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"

namespace penumbra::apps {
namespace {

constexpr int kSamples = 4'096;

nlohmann::json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json trace_pixel(const Scene& scene, const RenderResult& result, const RenderOptions& options,
                           std::uint32_t index) {
  const RayScene rays(scene, options.threads);
  const ReferenceOptions reference{.samples = kSamples, .seed = options.reference.seed};
  const ReferenceResult traced = trace_reference(scene, rays, result.surface, std::array{index}, reference);
  return {{"visibility", traced.visibility.front()}, {"samples", kSamples}, {"seed", reference.seed}};
}

}  // namespace

nlohmann::json probe_pixel(const Scene& scene, const RenderResult& result, const RenderOptions& options,
                           const PixelPair& pixel) {
  const auto index = static_cast<std::uint32_t>(pixel.y * result.image.width + pixel.x);
  const SurfaceBuffer& surface = result.surface;
  nlohmann::json report = {{"pixel", {pixel.x, pixel.y}}, {"method", name_of(options.method)}};
  report["object"] = surface.object[index];
  if (!surface.hit(index)) return report;
  const auto channel = [&](const char* name) { return result.image.at(name)[index]; };
  report["mesh"] = scene.objects[static_cast<std::size_t>(surface.object[index])].name;
  report["face"] = surface.face[index];
  report["P"] = to_json(surface.position[index]);
  report["N"] = to_json(surface.normal[index]);
  report["visibility"] = channel("visibility");
  if (result.image.has("region")) report["region"] = static_cast<int>(channel("region"));
  report["rgb"] = {channel("R"), channel("G"), channel("B")};
  if (options.method != Method::kReference) report["reference"] = trace_pixel(scene, result, options, index);
  return report;
}

}  // namespace penumbra::apps
