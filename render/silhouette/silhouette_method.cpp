#include "render/silhouette/silhouette_method.h"

#include <algorithm>

#include "penumbra/mesh/stage_clock.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_methods.h"
#include "render/rays/reference.h"
#include "render/silhouette/denoise.h"
#include "render/silhouette/edge_hierarchies.h"
#include "render/silhouette/silhouette_visibility.h"

namespace penumbra {
namespace {

Counts to_counts(const SilhouetteCounts& c, std::size_t open) {
  return {{"faces", c.faces},
          {"casters_that_cannot_occlude", c.casters_that_cannot_occlude},
          {"mesh_edges", c.mesh_edges},
          {"band_edges", c.band_edges},
          {"cut_edges", c.cut_edges},
          {"receivers", c.receivers},
          {"merged_receivers", c.merged_receivers},
          {"certified_lit", c.certified_lit},
          {"certified_umbra", c.certified_umbra},
          {"behind_light", c.behind_light},
          {"tiles", c.tiles},
          {"empty_tiles", c.empty_tiles},
          {"listed_edges", c.listed_edges},
          {"projected_edges", c.projected_edges},
          {"segments", c.segments},
          {"integrated", c.integrated},
          {"slabs", c.slabs},
          {"row_sweeps", c.row_sweeps},
          {"unresolved", c.unresolved},
          {"overlapping", c.overlapping},
          {"rays", c.rays},
          {"second_rays", c.second_rays},
          {"fallback", c.fallback},
          {"groupings", c.groupings},
          {"bytes", c.bytes},
          {"hierarchy_bytes", c.hierarchy_bytes},
          {"open", open}};
}

// Speed: about so many edges are looked at in the time of one ray. Looking for a certificate then takes no
// longer than to do without.
constexpr std::size_t kEdgesOfRay = 24, kFewEdges = 64;

constexpr const char* kAtrous = "a-trous";

std::vector<OptionSchema> rays_options() {
  std::vector<OptionSchema> options = sampling_options();
  options.push_back(
      {.name = "denoise",
       .domain = WordChoice{{"off", kAtrous}},
       .usual = std::string("off"),
       .unit = {},
       .help = "A filter over a picture's pixels, guided by position and normal, for few rays"});
  options.push_back({.name = "areas-up-to",
                     .domain = IntegerRange{0, 65'536},
                     .usual = std::uint64_t{0},
                     .unit = "edges across the light",
                     .help = "Receivers that see no more edges are integrated as by silhouette; 0: none is",
                     .steps = std::vector<OptionValue>{}});  // auto varies it
  return options;
}

/// What both methods share: hierarchies over edges, which serve every light.
class BySilhouettes : public Method {
 public:
  explicit BySilhouettes(const Scene& objects) : scene_(objects), hierarchies_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    MethodResult out;
    hierarchies_.take_groups(input.groups);
    see(input, hierarchies_, out);
    out.setup = {{"edge_hierarchy", hierarchies_.milliseconds()}};
    return out;
  }
  void forget() override { hierarchies_.forget_receivers(); }

 protected:
  virtual void see(const MethodInput& input, detail::EdgeHierarchies& hierarchies,
                   MethodResult& out) const = 0;
  const Scene& scene_;

 private:
  detail::EdgeHierarchies hierarchies_;
};

class SilhouetteMethod : public BySilhouettes {
 public:
  using BySilhouettes::BySilhouettes;

 private:
  void see(const MethodInput& input, detail::EdgeHierarchies& hierarchies, MethodResult& out) const override {
    SilhouetteOptions options{.rows = static_cast<int>(integer_of(input.options, "silhouette-rows")),
                              .tolerance = real_of(input.options, "silhouette-tolerance")};
    SilhouetteResult seen =
        silhouette_visibility(scene_, input.rays, hierarchies, input.light, input.receivers, options,
                              part_of(input.progress, 0.0, input.with_unoccluded ? 0.5 : 1.0));
    if (input.with_unoccluded) {
      options.horizon = false;
      out.unoccluded = silhouette_visibility(scene_, input.rays, hierarchies, input.light, input.receivers,
                                             options, part_of(input.progress, 0.5, 1.0))
                           .visibility;
    }
    out.visibility = std::move(seen.visibility);
    out.region = std::move(seen.region);
    out.stages = std::move(seen.stages);
    out.counts = to_counts(seen.counts, seen.open.size());
  }
};

class RaysMethod : public BySilhouettes {
 public:
  using BySilhouettes::BySilhouettes;

 private:
  void see(const MethodInput& input, detail::EdgeHierarchies& hierarchies, MethodResult& out) const override {
    SilhouetteResult seen =
        silhouette_visibility(scene_, input.rays, hierarchies, input.light, input.receivers,
                              rays_certificates(input.options), part_of(input.progress, 0.0, 0.5));
    StageClock clock;
    const ReferenceResult traced =
        trace_reference(input.rays, input.light, input.receivers, seen.open, sampling_of(input.options),
                        false, part_of(input.progress, 0.5, 1.0));
    for (std::size_t i = 0; i < seen.open.size(); ++i) seen.visibility[seen.open[i]] = traced.visibility[i];
    seen.counts.rays += traced.rays;
    clock.finish("rays");
    if (word_of(input.options, "denoise") == kAtrous) {
      seen.visibility = denoise(input.receivers, seen.visibility, seen.open,
                                {.samples = sampling_of(input.options).samples}, input.rays.arena());
      clock.finish("denoise");
    }
    out.visibility = std::move(seen.visibility);
    out.region = std::move(seen.region);
    out.stages = std::move(seen.stages);
    out.stages.insert(out.stages.end(), clock.stages().begin(), clock.stages().end());
    out.counts = to_counts(seen.counts, seen.open.size());
  }
};

}  // namespace

std::vector<OptionSchema> silhouette_options() {
  const SilhouetteOptions usual;
  return {
      {.name = "silhouette-rows",
       .domain = IntegerRange{4, 1024},
       .usual = static_cast<std::uint64_t>(usual.rows),
       .unit = "rows",
       .help = "Scanlines across the disk where more than 20 edges cross it; few edges are exact without"},
      {.name = "silhouette-tolerance",
       .domain = RealRange{0.0, 0.1},
       .usual = usual.tolerance,
       .unit = "light radii",
       .help =
           "How far silhouettes of fine casters may lie off by taking faces for one; 0: none are merged"}};
}

SilhouetteOptions rays_certificates(const OptionValues& options) {
  const auto up_to = static_cast<std::size_t>(integer_of(options, "areas-up-to"));
  const auto samples = static_cast<std::size_t>(integer_of(options, "samples"));
  // Few edges are left where areas are integrated: they are not worth a hierarchy of merged faces.
  return {.integrate = up_to > 0,
          .most_segments = up_to,
          .most_listed = std::max(kFewEdges, kEdgesOfRay * samples),
          .tolerance = 0.0};
}

MethodInfo silhouette_method() {
  return {.name = "silhouette",
          .summary = "exact areas between the edges that each receiver sees, without noise",
          .takes_distant = true,
          .certifies = true,
          .gives_unoccluded = true,
          .options = silhouette_options(),
          .make = [](const Scene& objects) { return std::make_unique<SilhouetteMethod>(objects); }};
}

MethodInfo rays_method() {
  return {.name = "rays",
          .summary = "stratified rays, only where nothing is certified",
          .takes_distant = true,
          .certifies = true,
          .options = rays_options(),
          .make = [](const Scene& objects) { return std::make_unique<RaysMethod>(objects); }};
}

}  // namespace penumbra
