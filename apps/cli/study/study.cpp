#include "apps/cli/study/study.h"

#include <algorithm>

#include "apps/cli/study/case_study.h"
#include "apps/cli/study/page/study_page.h"
#include "apps/common/machine.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

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

/// Errors are of less interest where cost is: fewer rays, none in double.
StudyOptions for_growth(StudyOptions options) {
  options.judge.samples = std::min(options.judge.samples, kGrowthSamples);
  options.judge.resample = false;
  options.judge.double_pixels = 0;
  return options;
}

/// Those that can be run here. Of others it is said why they have no rows.
std::vector<Peer> peers_at_hand(const StudyOptions& options) {
  std::vector<Peer> peers;
  if (!options.peers) return peers;
  for (Peer& peer : all_peers(options.three)) {
    if (!options.methods.empty() && std::ranges::find(options.methods, peer.name) == options.methods.end())
      continue;
    const std::string reason = peer.missing();
    if (reason.empty())
      peers.push_back(std::move(peer));
    else
      complain("no rows of " + peer.name + ": " + reason);
  }
  return peers;
}

/// All cases of a study one after the other, since scenes may be large.
class Study {
 public:
  Study(const StudyOptions& options, const Progress& progress)
      : options_(options),
        growth_(for_growth(options)),
        peers_(peers_at_hand(options)),
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
    CaseStudy study(record_, options_, peers_, path,
                    make_case(path.stem().string(), read(path), options_.view));
    measured_ += study.run(next_part());
    finish_part();
  }
  void run_growth() {
    const std::filesystem::path& path = options_.scenes.front();
    const Progress part = next_part();
    for (StudyCase& seen : growth_cases(path.stem().string(), read(path), options_.view))
      measured_ += CaseStudy(record_, growth_, peers_, path, std::move(seen)).run(part);
    for (int level = 0; level < kSpheres; ++level)
      measured_ +=
          CaseStudy(record_, growth_, peers_, {}, sphere_case(level, options_.view)).run(next_part());
    finish_part();
  }

  const StudyOptions& options_;
  const StudyOptions growth_;
  const std::vector<Peer> peers_;
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
