#include "apps/cli/study/study_plan.h"

#include <algorithm>

namespace penumbra::apps {
namespace {

/// Missing rows in units.
std::deque<StudyUnit> units_of(std::size_t number, const std::vector<CaseRow>& rows,
                               const std::vector<std::size_t>& missing, std::size_t group) {
  std::deque<StudyUnit> units;
  const Peer* peer = nullptr;
  for (const std::size_t k : missing) {
    const bool together =
        !units.empty() && rows[k].peer == peer && (peer != nullptr || units.back().rows.size() < group);
    if (!together) units.push_back({.case_number = number, .rows = {}});
    units.back().rows.push_back(k);
    peer = rows[k].peer;
  }
  return units;
}

}  // namespace

StudyPlan::StudyPlan(const StudyCases& cases, const StudyRecord& record, std::span<const Peer> peers,
                     const std::vector<std::string>& at_hand, std::size_t group)
    : begun_(cases.size(), false) {
  for (std::size_t number = 0; number < cases.size(); ++number) {
    const StudyCase seen = cases.make(number);
    const std::string digest = seen.digest();
    const std::vector<CaseRow> rows = rows_of(seen, cases.options(number), peers);
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const bool can = !rows[k].peer || std::ranges::find(at_hand, rows[k].peer->name) != at_hand.end();
      if (can && !record.has_row(key_of(seen, digest, rows[k].setting))) missing.push_back(k);
    }
    left_.push_back(units_of(number, rows, missing, group));
    all_ += left_.back().size();
  }
}

std::optional<StudyUnit> StudyPlan::next(int worker) {
  const auto take = [&](std::size_t number) {
    StudyUnit unit = std::move(left_[number].front());
    left_[number].pop_front();
    begun_[number] = true;
    case_of_[worker] = number;
    work_[worker] = unit;
    return unit;
  };
  if (const auto had = case_of_.find(worker); had != case_of_.end() && !left_[had->second].empty())
    return take(had->second);
  for (std::size_t number = 0; number < left_.size(); ++number)
    if (!begun_[number] && !left_[number].empty()) return take(number);
  const auto most = std::ranges::max_element(left_, {}, &std::deque<StudyUnit>::size);
  if (most == left_.end() || most->empty()) return std::nullopt;
  return take(static_cast<std::size_t>(most - left_.begin()));
}

void StudyPlan::finish(int worker) {
  finished_ += work_.erase(worker);
}

void StudyPlan::lose(int worker) {
  const auto lost = work_.find(worker);
  if (lost == work_.end()) return;
  left_[lost->second.case_number].push_front(std::move(lost->second));
  work_.erase(lost);
}

double StudyPlan::fraction() const {
  return all_ == 0 ? 1.0 : static_cast<double>(finished_) / static_cast<double>(all_);
}

bool StudyPlan::case_done(std::size_t number) const {
  return left_[number].empty() && std::ranges::none_of(work_, [number](const auto& entry) {
           return entry.second.case_number == number;
         });
}

}  // namespace penumbra::apps
