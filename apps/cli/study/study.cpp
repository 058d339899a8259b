#include "apps/cli/study/study.h"

#include <algorithm>

#include "apps/cli/ranks/ranks.h"
#include "apps/cli/ranks/shared_work.h"
#include "apps/cli/study/case_study.h"
#include "apps/cli/study/page/study_page.h"
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
                {"longest_frame_s", options.longest_frame_s},
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

  /// From bytes to bytes.
  std::string measure(const std::string& bytes) {
    const StudyUnit unit = unit_of(bytes);
    if (!study_ || number_ != unit.case_number) {
      study_.reset();
      number_ = unit.case_number;
      study_ = std::make_unique<CaseStudy>(cases_.options(number_), peers_, cases_.path(number_),
                                           cases_.make(number_));
    }
    return to_bytes(study_->measure(unit.rows));
  }

 private:
  const StudyCases& cases_;
  const std::span<const Peer> peers_;
  std::size_t number_ = 0;
  std::unique_ptr<CaseStudy> study_;
};

/// The plan, and the record that results go into.
class StudyWork : public WorkPlan {
 public:
  StudyWork(StudyPlan plan, StudyRecord& record) : plan_(std::move(plan)), record_(record) {}

  std::optional<std::string> next(int worker) override {
    const std::optional<StudyUnit> unit = plan_.next(worker);
    if (!unit) return std::nullopt;
    case_of_[worker] = unit->case_number;
    return to_bytes(*unit);
  }
  void finish(int worker, const std::string& bytes) override {
    const UnitResult result = result_of(bytes);
    plan_.finish(worker);
    measured_ += record_.add(result);
    if (!result.complaint.empty()) complain(result.complaint);
    if (plan_.case_done(case_of_.at(worker))) write();
  }
  void lose(int worker) override { plan_.lose(worker); }
  bool done() const override { return plan_.done(); }
  double fraction() const override { return plan_.fraction(); }

  /// Rows.
  std::size_t measured() const { return measured_; }
  void write() const {
    write_tables(record_);
    write_page(record_);
  }

 private:
  StudyPlan plan_;
  StudyRecord& record_;
  std::map<int, std::size_t> case_of_;  ///< by worker
  std::size_t measured_ = 0;
};

/// Returns how many rows were measured. `ranks` may be null.
std::size_t plan_and_write(const StudyOptions& options, const StudyCases& cases, std::span<const Peer> peers,
                           Bench& bench, Ranks* ranks, const Progress& progress) {
  StudyRecord record(options.output, about_of(options, ranks ? ranks->size() : 1));
  StudyWork work(StudyPlan(cases, record, peers, at_hand(peers, options), ranks ? 1 : kGroup), record);
  const DoUnit measure = [&bench](const std::string& unit) { return bench.measure(unit); };
  if (ranks)
    lead(*ranks, work, measure, progress);
  else
    work_alone(work, measure, progress);
  if (work.measured() == 0) work.write();
  return work.measured();
}

}  // namespace

std::optional<std::size_t> run_study(const StudyOptions& options, Ranks* ranks, const Progress& progress) {
  const std::vector<Peer> peers = options.peers ? all_peers(options.three) : std::vector<Peer>{};
  const StudyCases cases(options);
  Bench bench(cases, peers);
  if (!ranks || ranks->rank() == 0) return plan_and_write(options, cases, peers, bench, ranks, progress);
  follow(*ranks, [&bench](const std::string& unit) { return bench.measure(unit); });
  return std::nullopt;
}

}  // namespace penumbra::apps
