#include "apps/cli/study/study_cases.h"

#include <algorithm>

#include "apps/common/options.h"

namespace penumbra::apps {
namespace {

constexpr int kGrowthSamples = 1'024, kSpheres = 4;

StudyOptions for_growth(StudyOptions options) {
  options.judge.samples = std::min(options.judge.samples, kGrowthSamples);
  options.judge.resample = false;
  options.judge.double_pixels = 0;
  return options;
}

StudyCase named(const std::filesystem::path& path, const StudyView& view) {
  return make_case(path.stem().string(), load({.path = path}), view);
}

}  // namespace

StudyCases::StudyCases(const StudyOptions& options) : options_(options), growth_(for_growth(options)) {
  for (std::size_t k = 0; k < options.scenes.size(); ++k) sources_.push_back({Kind::kScene, k});
  if (!options.growth) return;
  for (std::size_t k = 0; k < growth_views(options.view).size(); ++k) sources_.push_back({Kind::kGrowth, k});
  for (std::size_t k = 0; k < kSpheres; ++k) sources_.push_back({Kind::kSphere, k});
}

StudyCase StudyCases::make(std::size_t number) const {
  const auto [kind, index] = sources_.at(number);
  if (kind == Kind::kScene) return named(options_.scenes[index], options_.view);
  if (kind == Kind::kSphere) return sphere_case(static_cast<int>(index), options_.view);
  const GrowthView grown = growth_views(options_.view)[index];
  StudyCase out = named(options_.scenes.front(), grown.view);
  out.sweep = grown.sweep;
  return out;
}

const StudyOptions& StudyCases::options(std::size_t number) const {
  return sources_.at(number).kind == Kind::kScene ? options_ : growth_;
}

std::filesystem::path StudyCases::path(std::size_t number) const {
  const auto [kind, index] = sources_.at(number);
  return kind == Kind::kScene ? options_.scenes[index] : std::filesystem::path{};
}

}  // namespace penumbra::apps
