#include "render/view_samples/view_samples_method.h"

#include "render/rays/point_light.h"
#include "render/rays/ray_methods.h"
#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"
#include "render/view_samples/view_samples.h"

namespace penumbra {
namespace {

Counts to_counts(const ViewSampleCounts& c) {
  return {{"faces", c.faces},
          {"receivers", c.receivers},
          {"listed_faces", c.listed_faces},
          {"masks", c.masks},
          {"covers", c.covers}};
}

class ViewSamplesMethod : public Method {
 public:
  explicit ViewSamplesMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    const ReferenceOptions sampling = sampling_of(input.options);
    ViewSampleOptions options{.samples = sampling.samples, .seed = sampling.seed};
    const double first = input.with_unoccluded ? 0.5 : 1.0;
    const auto seen = [&](double from, double to) {
      return view_sample_visibility(scene_, input.light, input.receivers, options, input.rays.arena(),
                                    part_of(input.progress, from, to));
    };
    MethodResult out;
    ViewSampleResult result = seen(0.0, first);
    out.counts = to_counts(result.counts);
    out.visibility = std::move(result.visibility);
    out.stages = std::move(result.stages);
    if (input.with_unoccluded) {
      options.horizon = false;
      result = seen(first, 1.0);
      out.unoccluded = std::move(result.visibility);
      out.stages.insert(out.stages.end(), result.stages.begin(), result.stages.end());
    }
    return out;
  }

 private:
  const Scene& scene_;
};

}  // namespace

MethodInfo view_samples_method() {
  return {.name = "view-samples",
          .summary = "light samples that the half-planes of each face hide: the result of rays, without rays",
          .takes_rectangles = true,
          .takes_distant = true,
          .gives_unoccluded = true,
          .converges = true,
          .options = sampling_options(),
          .make = [](const Scene& objects) { return std::make_unique<ViewSamplesMethod>(objects); }};
}

}  // namespace penumbra
