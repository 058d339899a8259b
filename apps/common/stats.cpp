#include "apps/common/stats.h"

#include "apps/common/machine.h"

namespace penumbra::apps {
namespace {

std::string renderer_of(const MethodFrame& frame, int threads) {
  return frame.renderer.empty() ? "Embree 3, " + std::to_string(threads) + " threads" : frame.renderer;
}

nlohmann::json light_stats(const MethodFrame& frame) {
  nlohmann::json json = {
      {"name", frame.light}, {"stages", to_json(frame.stages)}, {"counts", to_json(frame.counts)}};
  if (!frame.decisions.empty()) json["decisions"] = to_json(frame.decisions);
  return json;
}

}  // namespace

nlohmann::json to_json(const OptionValues& values) {
  auto json = nlohmann::json::object();
  for (const auto& [name, value] : values) std::visit([&](const auto& v) { json[name] = v; }, value);
  return json;
}

nlohmann::json to_json(const StageTimes& stages) {
  auto json = nlohmann::json::object();
  for (const StageTime& stage : stages) json[stage.name] = stage.milliseconds;
  return json;
}

nlohmann::json to_json(const Counts& counts) {
  auto json = nlohmann::json::object();
  for (const Count& count : counts) std::visit([&](const auto& v) { json[count.name] = v; }, count.value);
  return json;
}

nlohmann::json to_json(const std::vector<Decision>& decisions) {
  auto json = nlohmann::json::array();
  for (const Decision& each : decisions) {
    auto numbers = nlohmann::json::object();
    for (const DecisionNumber& number : each.numbers) numbers[number.name] = number.value;
    json.push_back({{"about", each.about},
                    {"choice", each.choice},
                    {"reason", each.reason},
                    {"text", each.text},
                    {"certificate", each.is_certificate},
                    {"numbers", std::move(numbers)}});
  }
  return json;
}

nlohmann::json stats_of(const RenderResult& result, int threads) {
  nlohmann::json json = {{"method", result.method},
                         {"options", to_json(result.options)},
                         {"stages", to_json(result.stages)},
                         {"frame_ms", result.frame_ms},
                         {"setup_ms", to_json(result.setup)},
                         {"width", result.surface.width},
                         {"height", result.surface.height},
                         {"threads", threads},
                         {"antialias", result.antialias},
                         {"scene_faces", result.scene_faces},
                         {"renderer", renderer_of(result.lights.front(), threads)},
                         {"peak_memory_bytes", peak_memory_bytes()}};
  if (result.lights.size() == 1) {
    json["counts"] = to_json(result.lights.front().counts);
    if (!result.lights.front().decisions.empty())
      json["decisions"] = to_json(result.lights.front().decisions);
  } else {
    for (const MethodFrame& frame : result.lights) json["lights"].push_back(light_stats(frame));
  }
  return json;
}

}  // namespace penumbra::apps
