#include "render/plan/auto_method.h"

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
  ReducedScene(const Scene& objects, const LightFacts& facts, const std::vector<char>& left_out)
      : left_out_(left_out) {
    for (const SceneObject& object : objects.objects)
      scene_.objects.push_back({.name = object.name, .mesh = object.mesh, .casts = object.casts});
    for (std::size_t k = 0; k < left_out.size(); ++k)
      if (left_out[k]) scene_.objects[facts.casters[k].object].casts = false;
  }

  const std::vector<char>& left_out() const { return left_out_; }
  Method& method(const std::string& name) {
    std::unique_ptr<Method>& made = methods_[name];
    if (!made) made = method_named(name).make(scene_);
    return *made;
  }
  void forget() {
    for (const auto& [name, method] : methods_) method->forget();
  }

 private:
  std::vector<char> left_out_;
  Scene scene_;
  std::map<std::string, std::unique_ptr<Method>, std::less<>> methods_;
};

PlanRequest request_of(const MethodInput& input) {
  return {.max_error = real_of(input.options, "max-error"), .with_unoccluded = input.with_unoccluded};
}

class AutoMethod : public Method {
 public:
  explicit AutoMethod(const Scene& objects) : objects_(objects) {}

  MethodResult run(const MethodInput& input) override {
    StageClock clock;
    const LightFacts facts = measure_light(objects_, input.rays, input.light, input.receivers,
                                           boxes_of(input), input.with_unoccluded);
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
    if (reduced_) reduced_->forget();
  }

 private:
  MethodResult run_method(const MethodInput& input, const LightFacts& facts, const LightPlan& plan) {
    if (!reduced_ || reduced_->left_out() != plan.left_out) reduced_.emplace(objects_, facts, plan.left_out);
    const MethodInfo& info = method_named(plan.method);
    const OptionValues options = completed(info.options, plan.options);
    return reduced_->method(plan.method)
        .run({.rays = input.rays,
              .light = input.light,
              .receivers = input.receivers,
              .options = options,
              .with_unoccluded = input.with_unoccluded,
              .keep_textures = input.keep_textures,
              .progress = input.progress});
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
  std::optional<ReducedScene> reduced_;
};

std::vector<OptionSchema> auto_options() {
  return {{.name = "max-error",
           .domain = RealRange{1e-4, 0.5},
           .usual = PlanRequest{}.max_error,
           .unit = {},
           .help = "RMSE of visibility over the penumbra that the chosen method may have",
           .steps = std::vector<OptionValue>{0.03, 0.01, 0.003}}};
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
  return make_plan(measure_light(objects, rays, light, receivers, *boxes, request.with_unoccluded), request);
}

}  // namespace penumbra
