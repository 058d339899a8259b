#include "apps/viewer/work/solid_maker.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/common/scene_volumes.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/solids/extrude_solid.h"

namespace penumbra::viewer {
namespace {

constexpr double kLongestToFollow = 0.3;  // seconds: drafts of the picture need the processor, too

LightShape circular_shape(const State& state) {
  if (std::holds_alternative<RectangleLight>(state.shape())) return disk_around(state.shape());
  return state.shape();
}

bool wants_same(const Overlays& a, const Overlays& b) {
  return a.umbra_solid == b.umbra_solid && a.penumbra_solid == b.penumbra_solid;
}

}  // namespace

std::vector<double> details_down_to(double finest) {
  std::vector<double> details;
  for (double each = kCoarsest; each > 1.4 * finest; each /= 2.0) details.push_back(each);
  details.push_back(finest);
  return details;
}

/// What one run of the thread is for.
struct SolidMaker::Task {
  std::shared_ptr<const Scene> model;
  LightShape light;
  Overlays wanted;
  std::vector<double> details;
  std::atomic<bool> cancelled = false;
  mutable std::atomic<bool> at_coarsest = false;
};

SolidMaker::~SolidMaker() {
  if (current_) current_->cancelled = true;
  if (task_.valid()) task_.wait();
}

bool SolidMaker::outdated(const State& state) const {
  return shown_ && (shown_->model != state.model || shown_->light != circular_shape(state));
}

// What is still to be made of this state's solids.
std::vector<double> SolidMaker::missing(const State& state, bool moving) const {
  std::vector<double> details = details_down_to(state.overlays.detail);
  const bool fits = shown_ && !outdated(state) && (shown_->umbra || !state.overlays.umbra_solid) &&
                    (shown_->penumbra || !state.overlays.penumbra_solid);
  if (shown_ && !outdated(state) && !shown_->trouble.empty()) return {};
  if (fits) std::erase_if(details, [&](double each) { return each >= shown_->detail; });
  if (moving) details.resize(fits || coarsest_took_ > kLongestToFollow ? 0 : 1);
  return details;
}

std::shared_ptr<const Solids> SolidMaker::update(const State& state, bool moving) {
  {
    const std::lock_guard lock(mutex_);
    if (ready_) shown_ = std::move(ready_);
    ready_ = nullptr;
  }
  if (task_.valid() && task_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) task_.get();
  if (task_.valid()) {
    const bool other = current_->model != state.model || current_->light != circular_shape(state) ||
                       !wants_same(current_->wanted, state.overlays) ||
                       current_->wanted.detail != state.overlays.detail;
    const bool may_end = current_->at_coarsest && current_->model == state.model && state.overlays.solids();
    if (other && !may_end) current_->cancelled = true;
  } else if (state.overlays.solids()) {
    if (std::vector<double> details = missing(state, moving); !details.empty())
      start(state, std::move(details));
  }
  return state.overlays.solids() && shown_ && shown_->model == state.model ? shown_ : nullptr;
}

void SolidMaker::start(const State& state, std::vector<double> details) {
  current_ = std::make_shared<Task>();
  current_->model = state.model;
  current_->light = circular_shape(state);
  current_->wanted = state.overlays;
  current_->details = std::move(details);
  task_ = std::async(std::launch::async, [this, task = current_] { run(*task); });
}

void SolidMaker::run(const Task& task) {
  try {
    for (const double detail : task.details) {
      const std::shared_ptr<const Solids> made = make(task, detail);
      {
        const std::lock_guard lock(mutex_);
        ready_ = made;
      }
      wake_();
      if (!made->trouble.empty() || task.cancelled) break;
    }
  } catch (const Cancelled&) {  // another light waits
  }
  wake_();
}

std::shared_ptr<const Solids> SolidMaker::make(const Task& task, double detail) {
  auto made = std::make_shared<Solids>();
  made->model = task.model;
  made->light = task.light;
  made->detail = detail_ = detail;
  task.at_coarsest = detail == kCoarsest;
  const auto start = std::chrono::steady_clock::now();
  const Bounds casters = task.model->caster_bounds();
  made->origin = casters.center();
  SolidOptions options{.tolerance = 2.0 * detail * casters.radius(),
                       .bound = apps::solid_bound_for(*task.model)};
  const bool both = task.wanted.umbra_solid && task.wanted.penumbra_solid;
  const auto solid = [&](ShadowLevel::Kind kind, double begin, double end) {
    options.progress = part_of(
        [&](double fraction) {
          fraction_ = fraction;
          return !task.cancelled;
        },
        begin, end);
    return solid_triangles(extrude_solid(*casters_, task.light, {kind}, options).mesh, made->origin);
  };
  try {
    if (casters_for_ != task.model) {
      casters_ = std::make_shared<const Casters>(task.model->objects);
      casters_for_ = task.model;
    }
    if (task.wanted.umbra_solid) made->umbra = solid(ShadowLevel::Kind::kUmbra, 0.0, both ? 0.5 : 1.0);
    if (task.wanted.penumbra_solid)
      made->penumbra = solid(ShadowLevel::Kind::kPenumbra, both ? 0.5 : 0.0, 1.0);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& e) {
    made->trouble = e.what();
  }
  if (detail == kCoarsest)
    coarsest_took_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return made;
}

std::string SolidMaker::activity() const {
  if (!busy()) return {};
  char text[80];
  std::snprintf(text, sizeof text, "umbra and penumbra at detail %.2g%%: %.0f%%", 100.0 * detail_,
                100.0 * fraction_);
  return text;
}

}  // namespace penumbra::viewer
