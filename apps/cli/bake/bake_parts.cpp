#include "apps/cli/bake/bake_parts.h"

#include <cstring>
#include <deque>
#include <map>
#include <string>

#include "apps/cli/ranks/shared_work.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

std::string to_bytes(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}
std::vector<float> floats_of(const std::string& bytes) {
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

class BakePlan : public WorkPlan {
 public:
  BakePlan(const BakeParts& parts, const PartStore& store) : parts_(parts), store_(store) {
    for (std::size_t part = 0; part < parts.count; ++part)
      if (!store.has(part, parts.values(part))) left_.push_back(part), all_ += parts.cost(part);
  }

  std::size_t left() const { return left_.size(); }
  std::optional<std::string> next(int worker) override {
    if (left_.empty()) return std::nullopt;
    const std::size_t part = left_.front();
    left_.pop_front();
    work_[worker] = part;
    return std::to_string(part);
  }
  void finish(int worker, const std::string& result) override {
    const std::size_t part = work_.at(worker);
    store_.write(part, floats_of(result));
    finished_ += parts_.cost(part);
    work_.erase(worker);
  }
  void lose(int worker) override {
    const auto lost = work_.find(worker);
    if (lost == work_.end()) return;
    left_.push_front(lost->second);
    work_.erase(lost);
  }
  bool done() const override { return left_.empty() && work_.empty(); }
  double fraction() const override { return all_ > 0.0 ? std::min(1.0, finished_ / all_) : 1.0; }
  /// Of all work, what one part is.
  double share(std::size_t part) const { return all_ > 0.0 ? parts_.cost(part) / all_ : 0.0; }

 private:
  const BakeParts& parts_;
  const PartStore& store_;
  std::deque<std::size_t> left_;
  std::map<int, std::size_t> work_;
  double all_ = 0.0, finished_ = 0.0;
};

}  // namespace

std::size_t bake_all(const BakeParts& parts, const PartStore& store, Ranks* ranks, const Progress& progress) {
  BakePlan plan(parts, store);
  const std::size_t had = parts.count - plan.left();
  if (ranks) {
    lead(
        *ranks, plan, [&](const std::string& unit) { return to_bytes(parts.bake(std::stoul(unit), {})); },
        progress);
    return had;
  }
  work_alone(
      plan,
      [&](const std::string& unit) {
        const std::size_t part = std::stoul(unit);
        const double begin = plan.fraction();
        return to_bytes(parts.bake(part, part_of(progress, begin, begin + plan.share(part))));
      },
      progress);
  return had;
}

void help(const BakeParts& parts, Ranks& ranks) {
  follow(ranks, [&](const std::string& unit) { return to_bytes(parts.bake(std::stoul(unit), {})); });
}

}  // namespace penumbra::apps
