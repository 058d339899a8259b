// study: which units are left, and who gets which. Whoever has a case keeps it, since its references are
// dear.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "apps/cli/study/study_cases.h"
#include "apps/cli/study/study_record.h"
#include "apps/cli/study/study_unit.h"

namespace penumbra::apps {

class StudyPlan {
 public:
  /// All units whose rows the record has not, of methods and of the peers that are named in `at_hand`. At
  /// most `group` rows of methods are a unit. Makes every case once, for its digest.
  StudyPlan(const StudyCases& cases, const StudyRecord& record, std::span<const Peer> peers,
            const std::vector<std::string>& at_hand, std::size_t group);

  /// The next unit for a worker, a number of his own: of the case that he has, of one that nobody has, of the
  /// one with the most units. Nothing where no unit is left; others may still be at work.
  std::optional<StudyUnit> next(int worker);
  /// The worker's unit is done.
  void finish(int worker);
  /// The worker is gone: his unit is done again.
  void lose(int worker);

  bool at_work(int worker) const { return work_.contains(worker); }
  /// Whether all is done.
  bool done() const { return finished_ == all_; }
  /// Of the units.
  double fraction() const;
  /// Whether none of the case's units is left or in work.
  bool case_done(std::size_t number) const;

 private:
  std::vector<std::deque<StudyUnit>> left_;
  /// By worker: his unit, and the case that he had last.
  std::map<int, StudyUnit> work_;
  std::map<int, std::size_t> case_of_;
  std::vector<bool> begun_;
  std::size_t all_ = 0, finished_ = 0;
};

}  // namespace penumbra::apps
