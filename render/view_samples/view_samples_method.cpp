#include "render/view_samples/view_samples_method.h"

#include "render/rays/point_light.h"
#include "render/rays/ray_methods.h"
#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"
#include "render/rays/with_unoccluded.h"
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
    const auto see = [&](bool horizon, const Progress& progress) {
      return view_sample_visibility(scene_, input.light, input.receivers,
                                    {.samples = sampling.samples, .seed = sampling.seed, .horizon = horizon},
                                    input.rays.arena(), progress);
    };
    return detail::see_with_unoccluded(input, see, to_counts);
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
          .options = dear_sampling_options(),
          .make = [](const Scene& objects) { return std::make_unique<ViewSamplesMethod>(objects); }};
}

}  // namespace penumbra
