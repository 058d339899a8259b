#include "apps/cli/study/study.h"

#include <algorithm>

#include "apps/cli/study/case_study.h"
#include "apps/cli/study/page/study_page.h"
#include "apps/cli/study/ranks/ranks.h"
#include "apps/cli/study/ranks/shared_work.h"
#include "apps/cli/study/study_cases.h"
#include "apps/cli/study/study_plan.h"
#include "apps/cli/study/study_record.h"
#include "apps/common/machine.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

/// Rows that are timed in turn; of several ranks each has one.
constexpr std::size_t kGroup = 6;

json about_of(const StudyOptions& options, int ranks) {
  json about = {{"machine", describe_machine()},
                {"threads", used_threads(options.judge.threads)},
                {"version", PENUMBRA_VERSION},
                {"commit", options.commit},
                {"frames", options.rounds},
                {"samples", options.judge.samples},
                {"resampled", options.judge.resample},
                {"double_pixels", options.judge.double_pixels},
                {"double_samples", options.judge.double_samples},
                {"default_method", kDefaultMethod}};
  if (ranks > 1) about["ranks"] = ranks;
  return about;
}

/// Names of those that can be run here. Of others it is said why they have no rows.
std::vector<std::string> at_hand(std::span<const Peer> peers, const StudyOptions& options) {
  std::vector<std::string> names;
  for (const Peer& peer : peers) {
    if (!options.methods.empty() && std::ranges::find(options.methods, peer.name) == options.methods.end())
      continue;
    const std::string reason = peer.missing();
    if (reason.empty())
      names.push_back(peer.name);
    else
      complain("no rows of " + peer.name + ": " + reason);
  }
  return names;
}

/// Measures units, one case in memory.
class Bench {
 public:
  Bench(const StudyCases& cases, std::span<const Peer> peers) : cases_(cases), peers_(peers) {}

  UnitResult measure(const StudyUnit& unit) {
    if (!study_ || number_ != unit.case_number) {
      study_.reset();
      number_ = unit.case_number;
      study_ = std::make_unique<CaseStudy>(cases_.options(number_), peers_, cases_.path(number_),
                                           cases_.make(number_));
    }
    return study_->measure(unit.rows);
  }

 private:
  const StudyCases& cases_;
  const std::span<const Peer> peers_;
  std::size_t number_ = 0;
  std::unique_ptr<CaseStudy> study_;
};

/// Returns how many rows were measured. `ranks` may be null.
std::size_t plan_and_write(const StudyOptions& options, const StudyCases& cases, std::span<const Peer> peers,
                           Bench& bench, Ranks* ranks, const Progress& progress) {
  StudyRecord record(options.output, about_of(options, ranks ? ranks->size() : 1));
  StudyPlan plan(cases, record, peers, at_hand(peers, options), ranks ? 1 : kGroup);
  std::size_t measured = 0;
  const auto write = [&record] {
    write_tables(record);
    write_page(record);
  };
  const TakeResult take = [&](std::size_t number, const UnitResult& result) {
    measured += record.add(result);
    if (!result.complaint.empty()) complain(result.complaint);
    if (plan.case_done(number)) write();
  };
  const MeasureUnit measure = [&bench](const StudyUnit& unit) { return bench.measure(unit); };
  if (ranks) {
    lead(*ranks, plan, measure, take, progress);
  } else {
    while (const auto unit = plan.next(0)) {
      report(progress, plan.fraction());
      const UnitResult result = measure(*unit);
      plan.finish(0);
      take(unit->case_number, result);
    }
  }
  if (measured == 0) write();
  return measured;
}

}  // namespace

std::optional<std::size_t> run_study(const StudyOptions& options, const Progress& progress) {
  const std::unique_ptr<Ranks> ranks = Ranks::of_this_run();
  const std::vector<Peer> peers = options.peers ? all_peers(options.three) : std::vector<Peer>{};
  const StudyCases cases(options);
  Bench bench(cases, peers);
  if (!ranks || ranks->rank() == 0)
    return plan_and_write(options, cases, peers, bench, ranks.get(), progress);
  follow(*ranks, [&bench](const StudyUnit& unit) { return bench.measure(unit); });
  return std::nullopt;
}

}  // namespace penumbra::apps
