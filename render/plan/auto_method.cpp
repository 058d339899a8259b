#include "render/plan/auto_method.h"

#include <algorithm>
#include <map>
#include <optional>

#include "penumbra/mesh/stage_clock.h"
#include "render/plan/light_facts.h"
#include "render/plan/unshadowed.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace {

using namespace detail;

/// Methods for the scene without some casters. Meshes are shared.
class ReducedScene {
 public:
  ReducedScene(const Scene& objects, const LightFacts& facts, const std::vector<char>& left_out) {
    for (const SceneObject& object : objects.objects)
      scene_.objects.push_back({.name = object.name, .mesh = object.mesh, .casts = object.casts});
    for (std::size_t k = 0; k < left_out.size(); ++k)
      if (left_out[k]) scene_.objects[facts.casters[k].object].casts = false;
  }

  Method& method(const std::string& name) {
    std::unique_ptr<Method>& made = methods_[name];
    if (!made) made = method_named(name).make(scene_);
    return *made;
  }
  void forget() {
    for (const auto& [name, method] : methods_) method->forget();
  }

 private:
  Scene scene_;
  std::map<std::string, std::unique_ptr<Method>, std::less<>> methods_;
};

PlanRequest request_of(const MethodInput& input) {
  return {.max_error = real_of(input.options, "max-error"),
          .max_ms = real_of(input.options, "max-ms"),
          .hard_below = real_of(input.options, "hard-below"),
          .with_unoccluded = input.with_unoccluded,
          .frames = static_cast<int>(integer_of(input.options, "plan-frames"))};
}

class AutoMethod : public Method {
 public:
  explicit AutoMethod(const Scene& objects) : objects_(objects) {}

  MethodResult run(const MethodInput& input) override {
    StageClock clock;
    const LightFacts facts =
        measure_light(objects_, input.rays, input.light, input.receivers, boxes_of(input), request_of(input));
    LightPlan plan = make_plan(facts, request_of(input));
    clock.finish("plan");
    MethodResult out =
        plan.action == LightPlan::Action::kMethod ? run_method(input, facts, plan) : see_unshadowed(input);
    if (out.region.empty()) out.region.assign(input.receivers.size(), -1);
    if (plan.action != LightPlan::Action::kMethod) {
      clock.finish("unshadowed");
      out.stages = clock.stages();
    } else {
      out.stages.insert(out.stages.begin(), clock.stages().begin(), clock.stages().end());
    }
    out.decisions = std::move(plan.decisions);
    return out;
  }

  void forget() override {
    boxes_.reset();
    for (const auto& [left_out, reduced] : reduced_) reduced->forget();
  }

 private:
  MethodResult run_method(const MethodInput& input, const LightFacts& facts, const LightPlan& plan) {
    const MethodInfo& info = method_named(plan.method);
    const OptionValues options = completed(info.options, plan.options);
    return without(facts, plan.left_out)
        .method(plan.method)
        .run({.rays = input.rays,
              .light = input.light,
              .receivers = input.receivers,
              .options = options,
              .with_unoccluded = input.with_unoccluded,
              .keep_textures = input.keep_textures,
              .progress = input.progress});
  }

  /// The scene without these casters, or one with more that is there already: what is made once is not made again. While a
  /// light moves they may be others in every frame: where they have been often, all casters are kept.
  ReducedScene& without(const LightFacts& facts, const std::vector<char>& left_out) {
    constexpr std::size_t kMost = 8;
    if (const auto same = reduced_.find(left_out); same != reduced_.end()) return *same->second;
    for (const auto& [fewer, reduced] : reduced_)
      if (std::ranges::equal(fewer, left_out, [](char a, char b) { return a <= b; })) return *reduced;
    const std::vector<char> used = reduced_.size() < kMost ? left_out : std::vector<char>(left_out.size(), 0);
    return *(reduced_[used] = std::make_unique<ReducedScene>(objects_, facts, used));
  }

  /// Kept while the receivers stay the same.
  const ReceiverBoxes& boxes_of(const MethodInput& input) {
    const std::uint64_t revision = input.receivers.revision;
    if (!boxes_ || revision == 0 || revision != revision_)
      input.rays.arena().execute([&] { boxes_.emplace(input.receivers); });
    revision_ = revision;
    return *boxes_;
  }

  const Scene& objects_;
  std::optional<ReceiverBoxes> boxes_;
  std::uint64_t revision_ = 0;
  /// By the flags of casters that are left out.
  std::map<std::vector<char>, std::unique_ptr<ReducedScene>> reduced_;
};

std::vector<OptionSchema> auto_options() {
  return {{.name = "max-error",
           .domain = RealRange{1e-4, 0.5},
           .usual = PlanRequest{}.max_error,
           .unit = {},
           .help = "RMSE of visibility over the penumbra that the chosen method may have",
           .steps = std::vector<OptionValue>{0.03, 0.01, 0.003}},
          {.name = "max-ms",
           .domain = RealRange{0.0, 1e9},
           .usual = PlanRequest{}.max_ms,
           .unit = "milliseconds",
           .help = "Time that the chosen method may take, by the model; where the error cannot be kept in "
                   "it, the most "
                   "accurate method that can keep the time; 0: no limit",
           .steps = std::vector<OptionValue>{}},
          {.name = "hard-below",
           .domain = RealRange{0.0, 10.0},
           .usual = PlanRequest{}.hard_below,
           .unit = "pixels",
           .help = "A penumbra that is nowhere as wide is drawn as a hard shadow; 0: none is",
           .steps = std::vector<OptionValue>{}},
          {.name = "plan-frames",
           .domain = IntegerRange{1, 1'000'000},
           .usual = static_cast<std::uint64_t>(PlanRequest{}.frames),
           .unit = "frames",
           .help = "Frames that share what a method makes once",
           .steps = std::vector<OptionValue>{}}};
}

}  // namespace

MethodInfo auto_method() {
  return {.name = "auto",
          .summary = "for each light the cheapest method that keeps an error, and only casters that matter",
          .takes_rectangles = true,
          .takes_distant = true,
          .certifies = true,
          .gives_unoccluded = true,
          .options = auto_options(),
          .make = [](const Scene& objects) { return std::make_unique<AutoMethod>(objects); }};
}

LightPlan plan_light(const Scene& objects, const RayScene& rays, const LightShape& light,
                     const Receivers& receivers, const PlanRequest& request) {
  std::optional<ReceiverBoxes> boxes;
  rays.arena().execute([&] { boxes.emplace(receivers); });
  return make_plan(measure_light(objects, rays, light, receivers, *boxes, request), request);
}

}  // namespace penumbra
