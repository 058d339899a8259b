#include "apps/cli/study/ranks/shared_work.h"

#include <chrono>
#include <set>
#include <thread>

#include "apps/common/messages.h"

namespace penumbra::apps {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kPause = 5ms, kBetweenSigns = 1s, kGone = 15s, kLater = 200ms;

enum Tag : int { kAsk = 1, kResult, kAlive, kUnit, kWait, kStop };

/// What rank 0's two threads share: the one that measures, and the one that answers.
class Leader {
 public:
  Leader(Ranks& ranks, StudyPlan& plan, const TakeResult& take) : ranks_(ranks), plan_(plan), take_(take) {
    for (int rank = 1; rank < ranks.size(); ++rank) last_sign_[rank] = Clock::now();
  }

  std::optional<StudyUnit> next() {
    const std::lock_guard lock(mutex_);
    return plan_.next(0);
  }
  void finish(int worker, std::size_t case_number, const UnitResult& result) {
    const std::lock_guard lock(mutex_);
    plan_.finish(worker);
    take_(case_number, result);
  }
  bool done() {
    const std::lock_guard lock(mutex_);
    return plan_.done();
  }
  double fraction() {
    const std::lock_guard lock(mutex_);
    return plan_.fraction();
  }

  /// Until every rank has been sent home or is gone.
  void answer_all() {
    while (last_sign_.size() > home_.size()) {
      while (const auto message = ranks_.poll()) answer(*message);
      look_for_gone();
      std::this_thread::sleep_for(kPause);
    }
    if (gone_) ranks_.abandon();
  }

 private:
  void answer(const RankMessage& message) {
    if (!last_sign_.contains(message.from)) return;  // it was taken for gone
    last_sign_[message.from] = Clock::now();
    if (message.tag == kResult) {
      const UnitResult result = result_of(message.bytes);
      const std::lock_guard lock(mutex_);
      const std::size_t number = units_.at(message.from).case_number;
      plan_.finish(message.from);
      take_(number, result);
    }
    if (message.tag == kAsk) give(message.from);
  }
  void give(int rank) {
    std::optional<StudyUnit> unit;
    bool done = false;
    {
      const std::lock_guard lock(mutex_);
      unit = plan_.next(rank);
      done = plan_.done();
    }
    if (unit) {
      units_[rank] = *unit;
      ranks_.send(rank, kUnit, to_bytes(*unit));
    } else if (done) {
      home_.insert(rank);
      ranks_.send(rank, kStop);
    } else {
      ranks_.send(rank, kWait);
    }
  }
  void look_for_gone() {
    for (auto sign = last_sign_.begin(); sign != last_sign_.end();) {
      if (home_.contains(sign->first) || Clock::now() - sign->second < kGone) {
        ++sign;
        continue;
      }
      const std::lock_guard lock(mutex_);
      plan_.lose(sign->first);
      gone_ = true;
      sign = last_sign_.erase(sign);
    }
  }

  Ranks& ranks_;
  StudyPlan& plan_;
  const TakeResult& take_;
  std::mutex mutex_;
  std::map<int, Clock::time_point> last_sign_;
  std::map<int, StudyUnit> units_;
  std::set<int> home_;
  bool gone_ = false;
};

/// What fails on one rank ends all: the others would wait for it.
void or_abort(Ranks& ranks, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    complain(error.what());
    ranks.abort();
  }
}

RankMessage wait_for_message(Ranks& ranks) {
  while (true) {
    if (auto message = ranks.poll()) return std::move(*message);
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace

void lead(Ranks& ranks, StudyPlan& plan, const MeasureUnit& measure, const TakeResult& take,
          const Progress& progress) {
  Leader leader(ranks, plan, take);
  std::jthread answers([&] { or_abort(ranks, [&] { leader.answer_all(); }); });
  or_abort(ranks, [&] {
    while (!leader.done()) {
      report(progress, leader.fraction());
      if (const auto unit = leader.next())
        leader.finish(0, unit->case_number, measure(*unit));
      else
        std::this_thread::sleep_for(kLater);
    }
  });
}

void follow(Ranks& ranks, const MeasureUnit& measure) {
  std::jthread signs([&ranks](const std::stop_token& stop) {
    for (auto next = Clock::now(); !stop.stop_requested(); std::this_thread::sleep_for(kPause)) {
      if (Clock::now() < next) continue;
      ranks.send(0, kAlive);
      next = Clock::now() + kBetweenSigns;
    }
  });
  or_abort(ranks, [&] {
    while (true) {
      ranks.send(0, kAsk);
      const RankMessage message = wait_for_message(ranks);
      if (message.tag == kStop) return;
      if (message.tag == kUnit)
        ranks.send(0, kResult, to_bytes(measure(unit_of(message.bytes))));
      else
        std::this_thread::sleep_for(kLater);
    }
  });
}

}  // namespace penumbra::apps
