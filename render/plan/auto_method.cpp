#include "render/plan/auto_method.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "penumbra/mesh/error.h"
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
  ReducedScene(const Scene& objects, const std::vector<std::size_t>& left_out) {
    for (const SceneObject& object : objects.objects)
      scene_.objects.push_back({.name = object.name, .mesh = object.mesh, .casts = object.casts});
    for (const std::size_t object : left_out) scene_.objects[object].casts = false;
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

constexpr std::array<const char*, 3> kChoices{"planned", "on", "off"};  // in the order of EffectChoice

std::string option_of(const EffectName& effect) {
  return std::string("effect-") + effect.name;
}

PlanRequest request_of(const MethodInput& input) {
  PlanRequest out{.max_error = real_of(input.options, "max-error"),
                  .max_ms = real_of(input.options, "max-ms"),
                  .hard_below = real_of(input.options, "hard-below"),
                  .with_unoccluded = input.with_unoccluded,
                  .frames = static_cast<int>(integer_of(input.options, "plan-frames")),
                  .speed = real_of(input.options, "plan-speed")};
  for (const EffectName& effect : kEffects) {
    const std::string& word = word_of(input.options, option_of(effect));
    out.effects.*effect.member = static_cast<EffectChoice>(
        std::ranges::find(kChoices, word, [](const char* choice) { return std::string_view(choice); }) -
        kChoices.begin());
  }
  return out;
}

/// Does what a plan says.
class PlannedMethod : public Method {
 public:
  explicit PlannedMethod(const Scene& objects) : objects_(objects) {}

  void forget() override {
    for (const auto& [left_out, reduced] : reduced_) reduced->forget();
  }

 protected:
  const Scene& objects() const { return objects_; }

  /// `groups`: the receivers, or nullptr.
  MethodResult follow(const MethodInput& input, const LightPlan& plan, const BoxedGroups* groups) {
    StageClock clock;
    if (plan.action == LightPlan::Action::kMethod) return run_method(input, plan, groups);
    MethodResult out;
    out.is_dark = plan.action == LightPlan::Action::kDark;
    if (out.is_dark) return out;
    out = see_unshadowed(input);
    clock.finish("unshadowed");
    out.stages = clock.stages();
    return out;
  }

 private:
  MethodResult run_method(const MethodInput& input, const LightPlan& plan, const BoxedGroups* groups) {
    const MethodInfo& info = method_named(plan.method);
    require_taken(info, input.light, input.receivers, input.with_unoccluded);
    const OptionValues options = completed(info.options, plan.options);
    return without(plan.left_out)
        .method(plan.method)
        .run({.rays = input.rays,
              .light = input.light,
              .receivers = input.receivers,
              .options = options,
              .with_unoccluded = input.with_unoccluded,
              .keep_textures = input.keep_textures,
              .progress = input.progress,
              .groups = groups});
  }

  /// The scene without these objects' shadows, or one with more that is there already: what is made once is
  /// not made again. While a light moves they may be others in every frame: where they have been often, all
  /// casters are kept.
  ReducedScene& without(const std::vector<std::size_t>& left_out) {
    constexpr std::size_t kMost = 8;
    if (const auto same = reduced_.find(left_out); same != reduced_.end()) return *same->second;
    for (const auto& [fewer, reduced] : reduced_)
      if (std::ranges::includes(left_out, fewer)) return *reduced;
    const std::vector<std::size_t> used = reduced_.size() < kMost ? left_out : std::vector<std::size_t>();
    return *(reduced_[used] = std::make_unique<ReducedScene>(objects_, used));
  }

  const Scene& objects_;
  /// By what is left out.
  std::map<std::vector<std::size_t>, std::unique_ptr<ReducedScene>> reduced_;
};

class AutoMethod : public PlannedMethod {
 public:
  using PlannedMethod::PlannedMethod;

  MethodResult run(const MethodInput& input) override {
    StageClock clock;
    const PlanRequest request = request_of(input);
    LightPlan plan = make_plan(
        measure_light(objects(), input.rays, input.light, input.receivers, boxes_of(input), request),
        request);
    clock.finish("plan");
    MethodResult out = follow(input, plan, &kept_->groups);
    if (out.region.empty() && !out.is_dark) out.region.assign(input.receivers.size(), -1);
    out.stages.insert(out.stages.begin(), clock.stages().begin(), clock.stages().end());
    out.decisions = std::move(plan.decisions);
    return out;
  }

  void forget() override {
    kept_.reset();
    PlannedMethod::forget();
  }

 private:
  /// Kept while the receivers stay the same.
  const ReceiverBoxes& boxes_of(const MethodInput& input) {
    const std::uint64_t revision = input.receivers.revision;
    if (!kept_ || revision == 0 || revision != revision_)
      input.rays.arena().execute([&] { kept_.emplace(input.receivers); });
    revision_ = revision;
    return kept_->boxes;
  }

  struct Kept {
    explicit Kept(const Receivers& receivers) : groups(receivers), boxes(groups) {}
    BoxedGroups groups;
    ReceiverBoxes boxes;
  };
  std::optional<Kept> kept_;
  std::uint64_t revision_ = 0;
};

class GivenPlanMethod : public PlannedMethod {
 public:
  GivenPlanMethod(const Scene& objects, const std::vector<LightShape>& lights,
                  const std::vector<LightPlan>& plans)
      : PlannedMethod(objects), lights_(lights), plans_(plans) {}

  MethodResult run(const MethodInput& input) override {
    const auto at = std::ranges::find(lights_, input.light) - lights_.begin();
    if (at == std::ssize(lights_)) throw UsageError("there is no plan for this light; make plans again");
    const LightPlan& plan = plans_[static_cast<std::size_t>(at)];
    MethodResult out = follow(input, plan, input.groups);
    if (out.region.empty() && !out.is_dark) out.region.assign(input.receivers.size(), -1);
    out.decisions = plan.decisions;
    return out;
  }

 private:
  std::vector<LightShape> lights_;
  std::vector<LightPlan> plans_;
};

std::vector<OptionSchema> auto_options() {
  std::vector<OptionSchema> options{
      {.name = "max-error",
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
       .steps = std::vector<OptionValue>{}},
      {.name = "plan-speed",
       .domain = RealRange{0.01, 100.0},
       .usual = PlanRequest{}.speed,
       .unit = {},
       .help = "How many times as fast this machine is as that of the model; see penumbra plan --calibrate",
       .steps = std::vector<OptionValue>{}}};
  for (const EffectName& effect : kEffects)
    options.push_back({.name = option_of(effect),
                       .domain = WordChoice{{kChoices.begin(), kChoices.end()}},
                       .usual = std::string(kChoices[0]),
                       .unit = {},
                       .help = effect.help,
                       .steps = std::vector<OptionValue>{}});
  return options;
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

MethodInfo given_plan_method(std::vector<LightShape> lights, std::vector<LightPlan> plans) {
  return {.name = "plan",
          .summary = "for each light what a given plan says",
          .takes_rectangles = true,
          .takes_distant = true,
          .certifies = true,
          .gives_unoccluded = true,
          .options = {},
          .make = [lights = std::move(lights), plans = std::move(plans)](const Scene& objects) {
            return std::make_unique<GivenPlanMethod>(objects, lights, plans);
          }};
}

LightPlan plan_light(const Scene& objects, const RayScene& rays, const LightShape& light,
                     const Receivers& receivers, const PlanRequest& request) {
  std::optional<ReceiverBoxes> boxes;
  rays.arena().execute([&] { boxes.emplace(receivers); });
  return make_plan(measure_light(objects, rays, light, receivers, *boxes, request), request);
}

}  // namespace penumbra
