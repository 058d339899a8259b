// What methods cost and how far they are off, by what was measured of a light.
//
// Times are those of the machine on which the constants of cost_model_fit.h were measured; what is compared
// are times of one machine, so a plan needs no other. The terms are those of tests/bench/plan_model.py, which
// fits them. `./run plan-model` measures and fits again; docs/plan.md has the residuals.
#pragma once

#include "penumbra/render/plan/plan.h"

namespace penumbra::detail {

/// Totals of the casters that are not left out.
struct CasterTotals {
  double faces = 0.0, edges = 0.0;
};
CasterTotals totals_of_reaching(const LightFacts& facts);
/// Whether a method is made for the casters that reach alone: it then has hierarchies of its own, so other
/// lights and frames do not share theirs.
bool is_worth_leaving_out(const LightFacts& facts);
/// Edges of the casters that a method is made for.
double edges_of_method(const LightFacts& facts);

/// Milliseconds of a frame's visibility, and of what is made once.
struct Cost {
  double frame = 0.0, setup = 0.0;
  double over(int frames) const { return frame + setup / frames; }
};

/// `merges`: fine faces are merged.
Cost cost_of_silhouette(const LightFacts& facts, bool merges = true);
/// `areas_up_to`: the option of that name.
Cost cost_of_rays(const LightFacts& facts, int samples, int areas_up_to);
Cost cost_of_reference(const LightFacts& facts, int samples);
/// Milliseconds that so many rays take at one receiver in penumbra.
double milliseconds_in_penumbra(const LightFacts& facts, int samples);

/// So many edges before the light take as long to integrate as so many rays to trace, about; 0 where that is
/// hardly any.
int areas_up_to(const LightFacts& facts, int samples);

/// RMSE of V over the penumbra.
double error_of_silhouette(const LightFacts& facts);
/// Of n stratified rays by pilots (sample/ray_error.h), which nineteen of twenty scenes keep; but no error of
/// rays where there are areas.
double error_of_rays(const LightFacts& facts, int samples, int areas_up_to = 0);
/// The least number of rays for that error, 4 to 65,536, of those whose strata make a square or nearly one.
/// `with_areas`: as many as areas_up_to() says.
int rays_for(const LightFacts& facts, double error, bool with_areas = false);

}  // namespace penumbra::detail
