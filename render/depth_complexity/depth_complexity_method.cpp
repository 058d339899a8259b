#include "render/depth_complexity/depth_complexity_method.h"

#include "penumbra/mesh/stage_clock.h"
#include "render/depth_complexity/depth_complexity.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_methods.h"
#include "render/rays/reference.h"
#include "render/rays/with_unoccluded.h"
#include "render/silhouette/edges/edges_of_scene.h"

namespace penumbra {
namespace {

Counts to_counts(const DepthComplexityCounts& c) {
  return {{"faces", c.faces},
          {"mesh_edges", c.mesh_edges},
          {"band_edges", c.band_edges},
          {"receivers", c.receivers},
          {"tiles", c.tiles},
          {"listed_edges", c.listed_edges},
          {"segments", c.segments},
          {"toggled_samples", c.toggled_samples},
          {"rays", c.rays},
          {"bytes", c.bytes}};
}

class DepthComplexityMethod : public Method {
 public:
  explicit DepthComplexityMethod(const Scene& objects) : scene_(objects), edges_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    StageClock clock;
    const detail::SceneEdges& edges = edges_.made(input.rays.arena());
    clock.finish("edge_hierarchy");
    const ReferenceOptions sampling = sampling_of(input.options);
    const auto see = [&](bool horizon, const Progress& progress) {
      return depth_complexity_visibility(
          scene_, input.rays, edges, input.light, input.receivers,
          {.samples = sampling.samples, .seed = sampling.seed, .horizon = horizon}, progress);
    };
    MethodResult out = detail::see_with_unoccluded(input, see, to_counts);
    out.setup = clock.stages();
    return out;
  }

 private:
  const Scene& scene_;
  detail::EdgesOfScene edges_;
};

}  // namespace

MethodInfo depth_complexity_method() {
  return {.name = "depth-complexity",
          .summary = "light samples that silhouettes toggle, one ray a receiver: the result of rays",
          .takes_rectangles = true,
          .takes_distant = true,
          .gives_unoccluded = true,
          .converges = true,
          .options = dear_sampling_options(),
          .make = [](const Scene& objects) { return std::make_unique<DepthComplexityMethod>(objects); }};
}

}  // namespace penumbra
