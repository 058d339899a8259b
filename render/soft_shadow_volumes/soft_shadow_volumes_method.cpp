#include "render/soft_shadow_volumes/soft_shadow_volumes_method.h"

#include "penumbra/mesh/stage_clock.h"
#include "render/rays/point_light.h"
#include "render/rays/with_unoccluded.h"
#include "render/silhouette/edges/edges_of_scene.h"
#include "render/soft_shadow_volumes/soft_shadow_volumes.h"

namespace penumbra {
namespace {

Counts to_counts(const SoftShadowVolumeCounts& c) {
  return {{"faces", c.faces},
          {"mesh_edges", c.mesh_edges},
          {"band_edges", c.band_edges},
          {"patches", c.patches},
          {"silhouette_edges", c.silhouette_edges},
          {"listed_edges", c.listed_edges},
          {"wedges", c.wedges},
          {"rays", c.rays},
          {"counted", c.counted}};
}

class SoftShadowVolumesMethod : public Method {
 public:
  explicit SoftShadowVolumesMethod(const Scene& objects) : scene_(objects), edges_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    StageClock clock;
    const detail::SceneEdges& edges = edges_.made(input.rays.arena());
    clock.finish("edge_hierarchy");
    const auto splits = static_cast<int>(integer_of(input.options, "light-splits"));
    const auto see = [&](bool horizon, const Progress& progress) {
      return soft_shadow_volumes(scene_, input.rays, edges, input.light, input.receivers,
                                 {.splits = splits, .horizon = horizon}, progress);
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

MethodInfo soft_shadow_volumes_method() {
  const SoftShadowVolumeOptions usual;
  return {
      .name = "soft-shadow-volumes",
      .summary = "exact areas behind the silhouettes that the light's center sees, added up",
      .takes_rectangles = true,
      .takes_distant = true,
      .gives_unoccluded = true,
      .options = {{.name = "light-splits",
                   .domain = IntegerRange{1, 8},
                   .usual = static_cast<std::uint64_t>(usual.splits),
                   .unit = "patches a side",
                   .help = "The light in N x N patches, each with the silhouettes that its own center sees",
                   .steps = std::vector<OptionValue>{std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3},
                                                     std::uint64_t{4}}}},
      .make = [](const Scene& objects) { return std::make_unique<SoftShadowVolumesMethod>(objects); }};
}

}  // namespace penumbra
