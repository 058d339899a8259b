#include "apps/cli/study/case_study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "apps/cli/study/study_disks.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"
#include "apps/common/stats.h"
#include "render/image/flip.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

/// Rows that are timed in turn.
constexpr std::size_t kGroup = 6;
/// Milliseconds of a frame: of rows that take longer it is not measured, which would take as long again.
constexpr double kMostForMemory = 1'000.0;

/// Numbers to six digits, all others as they are.
json rounded(json value) {
  if (value.is_structured())
    for (json& part : value) part = rounded(std::move(part));
  if (!value.is_number_float()) return value;
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value.get<double>());
  return std::strtod(text, nullptr);
}

json quartiles_json(const std::vector<double>& values) {
  const Quartiles q = quartiles_of(values);
  return {{"low", q.low}, {"median", q.median}, {"high", q.high}};
}

double visibility_ms(const StageTimes& stages) {
  double sum = 0.0;
  for (const StageTime& stage : stages)
    if (stage.name != "surface_buffer" && stage.name != "shading") sum += stage.milliseconds;
  return sum;
}

/// Linear RGB, three numbers a pixel, as bright as the picture is shown.
std::vector<float> exposed(const Image& image, double stops) {
  const auto gain = static_cast<float>(std::exp2(stops));
  std::vector<float> out;
  for (std::size_t i = 0; i < image.at("A").size(); ++i)
    for (const char* channel : {"R", "G", "B"}) out.push_back(gain * image.at(channel)[i]);
  return out;
}

}  // namespace

CaseStudy::CaseStudy(StudyRecord& record, const StudyOptions& options, std::span<const Peer> peers,
                     const std::filesystem::path& scene_path, StudyCase seen)
    : record_(record),
      options_(options),
      peers_(peers),
      scene_path_(scene_path),
      case_(std::move(seen)),
      digest_(case_.digest()) {}

std::string CaseStudy::key_of(const Setting& setting) const {
  return case_.id() + " | " + setting.label() + " | " + digest_;
}

std::vector<Setting> CaseStudy::missing_settings() const {
  std::vector<Setting> missing;
  for (const MethodInfo& method : methods()) {
    if (!options_.methods.empty() &&
        std::ranges::find(options_.methods, method.name) == options_.methods.end())
      continue;
    if (!takes(method, case_.scene.lights.front().shape)) continue;
    for (Setting& setting : settings_of(method, options_.quick))
      if ((case_.sweep.empty() || setting.varied.empty()) && !record_.has_row(key_of(setting)))
        missing.push_back(std::move(setting));
  }
  return missing;
}

void CaseStudy::begin(Renderer& renderer) {
  RenderResult lit =
      renderer.render({.method = "none", .width = case_.view.width, .height = case_.view.height});
  lit_ = make_lit_picture(std::move(lit.image));
  const std::string name = file_name_of(case_.id());
  const std::filesystem::path folder = record_.folder() / "pictures";
  std::filesystem::create_directories(folder);
  write_lit(folder / (name + ".lit.png"), lit_);
  about_ = case_.to_json();
  about_["lit_picture"] = name + ".lit.png";
  about_["reference_picture"] = name + ".reference.png";
  if (case_.sweep.empty() &&
      write_disks(folder / (name + ".disks.png"), case_, lit.surface, options_.judge.threads))
    about_["disks_picture"] = name + ".disks.png";
  about_["exposure_stops"] = lit_.exposure_stops;
  record_.add_case(rounded(about_));
}

double CaseStudy::flip_of(const Renderer& renderer, const Measured& measured,
                          const std::vector<float>& reference) const {
  const std::vector<float> map = flip_map(case_.view.width, case_.view.height,
                                          exposed(renderer.shade_again({reference}), lit_.exposure_stops),
                                          exposed(measured.image, lit_.exposure_stops));
  return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

json CaseStudy::row_of(const Setting& setting, const Measured& measured, const Renderer& renderer,
                       CaseJudge& judge) {
  json row = {{"key", key_of(setting)},      {"case", case_.id()},
              {"scene", case_.scene_name},   {"width", case_.view.width},
              {"height", case_.view.height}, {"light_scale", case_.view.light_scale},
              {"method", setting.method},    {"label", setting.label()},
              {"varied", setting.varied},    {"options", to_json(setting.options)}};
  if (!measured.refused.empty()) {
    row["refused"] = measured.refused;
    return row;
  }
  row["frame_ms"] = quartiles_json(measured.frames);
  row["frame_ms"]["frames"] = measured.frames.size();
  if (!measured.over_default.empty()) row["over_default"] = quartiles_json(measured.over_default);
  row["stages"] = to_json(measured.stages);
  row["visibility_ms"] = visibility_ms(measured.stages);
  if (!measured.renderer.empty()) row["renderer"] = measured.renderer;
  if (options_.memory && case_.sweep.empty() && quartiles_of(measured.frames).median < kMostForMemory)
    if (const auto peak = peak_memory(scene_path_.string(), case_.view, setting)) row["peak_mib"] = *peak;
  const Verdict verdict = judge.judge(measured);
  row["error"] = to_json(verdict);
  row["error"]["flip"] = flip_of(renderer, measured, verdict.by_rays.reference);
  const std::filesystem::path folder = record_.folder() / "pictures";
  if (!has_reference_)
    write_reference(folder / (file_name_of(case_.id()) + ".reference.png"), lit_, verdict.by_rays.reference);
  has_reference_ = true;
  row["picture"] = file_name_of(case_.id() + "-" + setting.label() + ".png");
  write_error(folder / row["picture"].get<std::string>(), measured.image, measured.visibility,
              verdict.by_rays.reference, measured.region);
  return row;
}

void CaseStudy::measure(Renderer& renderer, CaseJudge& judge, std::span<const Setting> settings) {
  const std::vector<Measured> measured = measure_in_turn(renderer, case_.view, settings, options_.rounds);
  for (std::size_t k = 0; k < settings.size(); ++k)
    record_.add_row(rounded(row_of(settings[k], measured[k], renderer, judge)));
}

std::vector<Setting> CaseStudy::missing_of(const Peer& peer) const {
  if (!case_.sweep.empty() || !takes(peer, case_.scene.lights.front().shape)) return {};
  std::vector<Setting> missing = peer.settings;
  std::erase_if(missing, [&](const Setting& setting) { return record_.has_row(key_of(setting)); });
  return missing;
}

std::size_t CaseStudy::measure_peer(Renderer& renderer, CaseJudge& judge, const Peer& peer) {
  const std::vector<Setting> settings = missing_of(peer);
  if (settings.empty()) return 0;
  std::vector<Measured> measured;
  try {
    measured = peer.measure({.seen = case_,
                             .unshadowed = lit_.image,
                             .rounds = options_.rounds,
                             .threads = used_threads(options_.judge.threads)},
                            settings);
  } catch (const std::exception& error) {
    complain(case_.id() + " has no rows of " + peer.name + ": " + error.what());
  }
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const Image shaded = renderer.shade_again({measured[k].visibility});
    for (const char* channel : {"R", "G", "B"}) measured[k].image.channels[channel] = shaded.at(channel);
    record_.add_row(rounded(row_of(settings[k], measured[k], renderer, judge)));
  }
  return measured.size();
}

std::size_t CaseStudy::run(const Progress& progress) {
  const std::vector<Setting> missing = missing_settings();
  if (missing.empty() &&
      std::ranges::all_of(peers_, [&](const Peer& peer) { return missing_of(peer).empty(); }))
    return 0;
  Renderer renderer(case_.scene, options_.judge.threads);
  CaseJudge judge(case_, options_.judge);
  begin(renderer);
  for (std::size_t from = 0; from < missing.size(); from += kGroup) {
    report(progress, static_cast<double>(from) / static_cast<double>(missing.size()));
    measure(renderer, judge, std::span(missing).subspan(from, std::min(kGroup, missing.size() - from)));
  }
  std::size_t measured = missing.size();
  for (const Peer& peer : peers_) measured += measure_peer(renderer, judge, peer);
  return measured;
}

}  // namespace penumbra::apps
