#include "apps/cli/probe.h"

#include <array>

#include "penumbra/render/visibility.h"

namespace penumbra::apps {
namespace {

constexpr std::uint64_t kSamples = 4'096;

nlohmann::json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

std::uint64_t seed_of(const RenderResult& result) {
  const auto seed = result.options.find("seed");
  return seed == result.options.end() ? 1 : std::get<std::uint64_t>(seed->second);
}

nlohmann::json trace_point(const Casters& casters, const Scene& scene, const RenderResult& result,
                           std::size_t light, std::size_t index) {
  const std::array points{result.surface.position[index]}, normals{result.surface.normal[index]};
  const std::array objects{result.surface.object[index]};
  const std::array faces{result.surface.face[index]};
  const std::uint64_t seed = seed_of(result);
  const MethodResult traced =
      visibility(casters, scene.lights[light].shape,
                 {.points = points, .normals = normals, .objects = objects, .faces = faces},
                 {.method = "reference", .options = {{"samples", kSamples}, {"seed", seed}}});
  return {{"visibility", traced.visibility.front()}, {"samples", kSamples}, {"seed", seed}};
}

}  // namespace

nlohmann::json probe_pixel(const Scene& scene, const RenderResult& result, int threads,
                           const PixelPair& pixel) {
  const auto index = static_cast<std::size_t>(pixel.y * result.image.width + pixel.x);
  const SurfaceBuffer& surface = result.surface;
  nlohmann::json report = {{"pixel", {pixel.x, pixel.y}}, {"method", result.method}};
  report["object"] = surface.object[index];
  if (!surface.hit(index)) return report;
  const auto channel = [&](const std::string& name) { return result.image.at(name)[index]; };
  report["mesh"] = scene.objects[static_cast<std::size_t>(surface.object[index])].name;
  report["face"] = surface.face[index];
  report["P"] = to_json(surface.position[index]);
  report["N"] = to_json(surface.normal[index]);
  report["rgb"] = {channel("R"), channel("G"), channel("B")};
  const bool several = scene.lights.size() > 1;
  const Casters casters(scene.objects, threads);
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    const std::string& name = scene.lights[k].name;
    const auto at = [&](const char* key) -> nlohmann::json& {
      return several ? report[key][name] : report[key];
    };
    const std::string suffix = several ? "." + name : "";
    at("visibility") = channel("visibility" + suffix);
    at("region") = static_cast<int>(channel("region" + suffix));
    if (result.method != "reference") at("reference") = trace_point(casters, scene, result, k, index);
  }
  return report;
}

}  // namespace penumbra::apps
