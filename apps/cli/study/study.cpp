#include "apps/cli/study/study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "apps/cli/study/peers/povray.h"
#include "apps/cli/study/settings.h"
#include "apps/cli/study/study_disks.h"
#include "apps/cli/study/study_page.h"
#include "apps/cli/study/study_pictures.h"
#include "apps/cli/study/study_record.h"
#include "apps/common/machine.h"
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
/// Of the cases that show how cost grows.
constexpr int kGrowthSamples = 1'024, kSpheres = 4;

json about_of(const StudyOptions& options) {
  return {{"machine", describe_machine()},
          {"threads", used_threads(options.judge.threads)},
          {"version", PENUMBRA_VERSION},
          {"commit", options.commit},
          {"frames", options.rounds},
          {"samples", options.judge.samples},
          {"resampled", options.judge.resample},
          {"double_pixels", options.judge.double_pixels},
          {"double_samples", options.judge.double_samples},
          {"default_method", kDefaultMethod}};
}

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

/// One case: what all of its rows share.
class CaseStudy {
 public:
  CaseStudy(StudyRecord& record, const StudyOptions& options, const std::filesystem::path& scene_path,
            StudyCase seen)
      : record_(record), options_(options), scene_path_(scene_path), case_(std::move(seen)) {}

  /// Returns how many rows were measured.
  std::size_t run(const Progress& progress);

 private:
  std::string key_of(const Setting& setting) const {
    return case_.id() + " | " + setting.label() + " | " + digest_;
  }
  std::vector<Setting> missing_settings() const;
  /// Draws the case without shadows, and names it in the record.
  void begin(Renderer& renderer);
  /// The mean of FLIP against the reference's visibility in the same picture.
  double flip_of(const Renderer& renderer, const Measured& measured,
                 const std::vector<float>& reference) const;
  json row_of(const Setting& setting, const Measured& measured, const Renderer& renderer, CaseJudge& judge);
  void measure(Renderer& renderer, CaseJudge& judge, std::span<const Setting> settings);
  /// Those that are no methods, in pictures of their own.
  std::vector<Setting> missing_peers() const;
  std::size_t measure_peers(Renderer& renderer, CaseJudge& judge, std::span<const Setting> settings);

  StudyRecord& record_;
  const StudyOptions& options_;
  const std::filesystem::path scene_path_;
  const StudyCase case_;
  const std::string digest_ = case_.digest();
  json about_;
  LitPicture lit_;
  bool has_reference_ = false;
};

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

std::vector<Setting> CaseStudy::missing_peers() const {
  if (!options_.peers || !case_.sweep.empty() || !options_.methods.empty()) return {};
  std::vector<Setting> missing = povray_settings();
  std::erase_if(missing, [&](const Setting& setting) { return record_.has_row(key_of(setting)); });
  return missing;
}

std::size_t CaseStudy::measure_peers(Renderer& renderer, CaseJudge& judge,
                                     std::span<const Setting> settings) {
  std::size_t count = 0;
  for (const Setting& setting : settings) {
    auto measured =
        measure_povray(case_, setting, options_.rounds, used_threads(options_.judge.threads), lit_.image);
    if (!measured) break;
    const Image shaded = renderer.shade_again({measured->visibility});
    for (const char* channel : {"R", "G", "B"}) measured->image.channels[channel] = shaded.at(channel);
    record_.add_row(rounded(row_of(setting, *measured, renderer, judge)));
    ++count;
  }
  return count;
}

std::size_t CaseStudy::run(const Progress& progress) {
  const std::vector<Setting> missing = missing_settings(), peers = missing_peers();
  if (missing.empty() && (peers.empty() || !has_povray())) return 0;
  Renderer renderer(case_.scene, options_.judge.threads);
  CaseJudge judge(case_, options_.judge);
  begin(renderer);
  for (std::size_t from = 0; from < missing.size(); from += kGroup) {
    report(progress, static_cast<double>(from) / static_cast<double>(missing.size()));
    measure(renderer, judge, std::span(missing).subspan(from, std::min(kGroup, missing.size() - from)));
  }
  return missing.size() + measure_peers(renderer, judge, peers);
}

/// Errors are of less interest where cost is: fewer rays, none in double.
StudyOptions for_growth(StudyOptions options) {
  options.judge.samples = std::min(options.judge.samples, kGrowthSamples);
  options.judge.resample = false;
  options.judge.double_pixels = 0;
  return options;
}

/// All cases of a study one after the other, since scenes may be large.
class Study {
 public:
  Study(const StudyOptions& options, const Progress& progress)
      : options_(options),
        growth_(for_growth(options)),
        record_(options.output, about_of(options)),
        progress_(progress),
        parts_(options.scenes.size() + (options.growth ? 1 + kSpheres : 0)) {}

  std::size_t run() {
    for (const std::filesystem::path& path : options_.scenes) run_scene(path);
    if (options_.growth) run_growth();
    return measured_;
  }

 private:
  Scene read(const std::filesystem::path& path) const { return load({.path = path}); }
  Progress next_part() {
    const double from = part_++, all = static_cast<double>(parts_);
    return part_of(progress_, from / all, (from + 1.0) / all);
  }
  void finish_part() {
    write_tables(record_);
    write_page(record_);
  }
  void run_scene(const std::filesystem::path& path) {
    CaseStudy study(record_, options_, path, make_case(path.stem().string(), read(path), options_.view));
    measured_ += study.run(next_part());
    finish_part();
  }
  void run_growth() {
    const std::filesystem::path& path = options_.scenes.front();
    const Progress part = next_part();
    for (StudyCase& seen : growth_cases(path.stem().string(), read(path), options_.view))
      measured_ += CaseStudy(record_, growth_, path, std::move(seen)).run(part);
    for (int level = 0; level < kSpheres; ++level)
      measured_ += CaseStudy(record_, growth_, {}, sphere_case(level, options_.view)).run(next_part());
    finish_part();
  }

  const StudyOptions& options_;
  const StudyOptions growth_;
  StudyRecord record_;
  const Progress& progress_;
  std::size_t parts_;
  int part_ = 0;
  std::size_t measured_ = 0;
};

}  // namespace

std::size_t run_study(const StudyOptions& options, const Progress& progress) {
  return Study(options, progress).run();
}

}  // namespace penumbra::apps
