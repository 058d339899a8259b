#include "apps/cli/study/case_study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "apps/cli/study/pictures/study_disks.h"
#include "apps/common/options.h"
#include "apps/common/stats.h"
#include "render/image/flip.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

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

CaseStudy::CaseStudy(const StudyOptions& options, std::span<const Peer> peers,
                     std::filesystem::path scene_path, StudyCase seen)
    : options_(options),
      scene_path_(std::move(scene_path)),
      case_(std::move(seen)),
      digest_(case_.digest()),
      rows_(rows_of(case_, options, peers)),
      judge_(case_, options.judge),
      too_long_(1e3 * options.longest_frame_s) {}

void CaseStudy::begin() {
  renderer_ = std::make_unique<Renderer>(case_.scene, options_.judge.threads);
  RenderResult lit =
      renderer_->render({.method = "none", .width = case_.view.width, .height = case_.view.height});
  lit_ = make_lit_picture(std::move(lit.image));
  const std::string name = file_name_of(case_.id());
  about_ = case_.to_json();
  about_["exposure_stops"] = lit_.exposure_stops;
  about_["lit_picture"] = name + ".lit.webp";
  about_["reference_picture"] = name + ".reference.webp";
  pictures_[name + ".lit.webp"] = encode_lit(lit_);
  if (!case_.sweep.empty()) return;
  if (auto disks = encode_disks(case_, lit.surface, options_.judge.threads)) {
    about_["disks_picture"] = name + ".disks.webp";
    pictures_[name + ".disks.webp"] = std::move(*disks);
  }
}

double CaseStudy::flip_of(const Measured& measured, const std::vector<float>& reference) const {
  const std::vector<float> map = flip_map(case_.view.width, case_.view.height,
                                          exposed(renderer_->shade_again({reference}), lit_.exposure_stops),
                                          exposed(measured.image, lit_.exposure_stops));
  return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

json CaseStudy::row_of(const Setting& setting, const Measured& measured, UnitResult& result) {
  json row = {{"key", key_of(case_, digest_, setting)},
              {"case", case_.id()},
              {"scene", case_.scene_name},
              {"width", case_.view.width},
              {"height", case_.view.height},
              {"light_scale", case_.view.light_scale},
              {"method", setting.method},
              {"label", setting.label()},
              {"varied", setting.varied},
              {"options", to_json(setting.options)}};
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
  const Verdict verdict = judge_.judge(measured);
  const std::vector<float>& reference = verdict.by_rays.reference;
  row["error"] = to_json(verdict);
  row["error"]["flip"] = flip_of(measured, reference);
  std::string& drawn = pictures_[about_.at("reference_picture").get<std::string>()];
  if (drawn.empty()) drawn = encode_reference(lit_, reference);
  const std::string name = file_name_of(case_.id() + "-" + setting.label());
  row["picture"] = name + ".webp";
  row["small_picture"] = name + ".small.webp";
  const auto error = [&](int step_factor) {
    return encode_error(measured.image, measured.visibility, reference, measured.region, step_factor);
  };
  result.pictures[name + ".webp"] = error(1);
  result.pictures[name + ".small.webp"] = error(2);
  return row;
}

void CaseStudy::measure_methods(std::span<const Setting> settings, UnitResult& result) {
  const std::vector<Measured> measured =
      measure_in_turn(*renderer_, case_.view, settings, options_.rounds, too_long_);
  for (std::size_t k = 0; k < settings.size(); ++k) {
    json row = row_of(settings[k], measured[k], result);
    const bool by_default = settings[k].varied.empty() && measured[k].refused.empty();
    const double median = quartiles_of(measured[k].frames).median;
    if (options_.memory && !scene_path_.empty() && by_default && median < kMostForMemory)
      if (const auto peak =
              peak_memory(scene_path_.string(), case_.view, settings[k], options_.judge.threads))
        row["peak_mib"] = *peak;
    result.rows.push_back(rounded(std::move(row)));
  }
}

void CaseStudy::measure_peer(const Peer& peer, std::span<const Setting> settings, UnitResult& result) {
  std::vector<Measured> measured;
  try {
    measured = peer.measure({.seen = case_,
                             .unshadowed = lit_.image,
                             .rounds = options_.rounds,
                             .threads = used_threads(options_.judge.threads)},
                            settings);
  } catch (const std::exception& error) {
    result.complaint = case_.id() + " has no rows of " + peer.name + ": " + error.what();
  }
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const Image shaded = renderer_->shade_again({measured[k].visibility});
    for (const char* channel : {"R", "G", "B"}) measured[k].image.channels[channel] = shaded.at(channel);
    result.rows.push_back(rounded(row_of(settings[k], measured[k], result)));
  }
}

UnitResult CaseStudy::measure(std::span<const std::size_t> rows) {
  if (!renderer_) begin();
  std::vector<Setting> settings;
  for (const std::size_t number : rows) settings.push_back(rows_.at(number).setting);
  UnitResult result;
  if (const Peer* peer = rows_.at(rows.front()).peer)
    measure_peer(*peer, settings, result);
  else
    measure_methods(settings, result);
  result.seen = rounded(about_);
  result.pictures.insert(pictures_.begin(), pictures_.end());
  return result;
}

}  // namespace penumbra::apps
