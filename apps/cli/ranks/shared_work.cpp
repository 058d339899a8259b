#include "apps/cli/ranks/shared_work.h"

#include <chrono>
#include <map>
#include <set>
#include <thread>

#include "apps/common/messages.h"

namespace penumbra::apps {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kPause = 5ms, kBetweenSigns = 1s, kGone = 15s, kLater = 200ms;

enum Tag : int { kAsk = 1, kResult, kAlive, kUnit, kWait, kStop, kLeave };

/// What rank 0's two threads share: the one that works, and the one that answers.
class Leader {
 public:
  Leader(Ranks& ranks, WorkPlan& plan) : ranks_(ranks), plan_(plan) {
    for (int rank = 1; rank < ranks.size(); ++rank) last_sign_[rank] = Clock::now();
  }

  std::optional<std::string> next() {
    const std::lock_guard lock(mutex_);
    return plan_.next(0);
  }
  void finish(const std::string& result) {
    const std::lock_guard lock(mutex_);
    plan_.finish(0, result);
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
    if (!last_sign_.contains(message.from)) {  // it was taken for gone
      if (message.tag == kAsk) ranks_.send(message.from, kLeave);
      return;
    }
    last_sign_[message.from] = Clock::now();
    if (message.tag == kResult) {
      const std::lock_guard lock(mutex_);
      plan_.finish(message.from, message.bytes);
    }
    if (message.tag == kAsk) give(message.from);
  }
  void give(int rank) {
    std::optional<std::string> unit;
    bool done = false;
    {
      const std::lock_guard lock(mutex_);
      unit = plan_.next(rank);
      done = plan_.done();
    }
    if (unit) {
      ranks_.send(rank, kUnit, *unit);
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
  WorkPlan& plan_;
  std::mutex mutex_;
  std::map<int, Clock::time_point> last_sign_;
  std::set<int> home_;
  bool gone_ = false;
};

RankMessage wait_for_message(Ranks& ranks) {
  while (true) {
    if (auto message = ranks.poll()) return std::move(*message);
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace

void or_abort(Ranks& ranks, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    complain(error.what());
    ranks.abort();
  }
}

void or_abort_where_lost(Ranks* ranks, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    if (!ranks || !ranks->is_abandoned()) throw;
    complain(error.what());
    ranks->abort();
  }
}

void lead(Ranks& ranks, WorkPlan& plan, const DoUnit& work, const Progress& progress) {
  Leader leader(ranks, plan);
  std::jthread answers([&] { or_abort(ranks, [&] { leader.answer_all(); }); });
  or_abort(ranks, [&] {
    while (!leader.done()) {
      report(progress, leader.fraction());
      if (const auto unit = leader.next())
        leader.finish(work(*unit));
      else
        std::this_thread::sleep_for(kLater);
    }
  });
}

void follow(Ranks& ranks, const DoUnit& work) {
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
      if (message.tag == kLeave) return ranks.abandon();
      if (message.tag == kUnit)
        ranks.send(0, kResult, work(message.bytes));
      else
        std::this_thread::sleep_for(kLater);
    }
  });
}

void work_alone(WorkPlan& plan, const DoUnit& work, const Progress& progress) {
  while (const auto unit = plan.next(0)) {
    report(progress, plan.fraction());
    plan.finish(0, work(*unit));
  }
}

}  // namespace penumbra::apps
