#include "render/plan/candidates.h"

#include <algorithm>
#include <cstdint>

#include "render/plan/cost_model.h"

namespace penumbra::detail {
namespace {

std::uint64_t unsigned_of(int number) {
  return static_cast<std::uint64_t>(number);
}

/// What may be run for a light, in the order in which it is preferred at equal time.
class Candidates {
 public:
  Candidates(const LightFacts& facts, const PlanRequest& request) : facts_(facts), request_(request) {
    const Effects& effects = request.effects;
    is_certified_ = !facts.is_rectangle && effects.certificates != EffectChoice::kOff;
    has_areas_ = is_certified_ && effects.areas != EffectChoice::kOff;
    unmerged_ = facts;
    for (SampledPart* part : {&unmerged_.sampled.lit, &unmerged_.sampled.penumbra, &unmerged_.sampled.hidden})
      part->merged_edges = part->edges;
  }

  /// With as many rays as the error asks for, and with fewer where time is limited.
  std::vector<Candidate> all() {
    const EffectChoice merging = request_.effects.merging;
    if (has_areas_ && merging != EffectChoice::kOn) add_silhouette(unmerged_, false);
    if (has_areas_ && merging != EffectChoice::kOff) add_silhouette(facts_, true);
    if (request_.effects.areas == EffectChoice::kOn) return std::move(out_);
    const double error = request_.max_error;
    // Certificates are of V: rays that have them do not give O.
    const bool has_rays = is_certified_ && !request_.with_unoccluded;
    if (has_rays && has_areas_)
      for_fewer(rays_for(facts_, error, true),
                [&](int samples) { add_rays(samples, areas_up_to(facts_, samples)); });
    if (has_rays) for_fewer(rays_for(facts_, error), [&](int samples) { add_rays(samples, 0); });
    if (request_.effects.certificates != EffectChoice::kOn)
      for_fewer(rays_for(facts_, error), [&](int samples) { add_reference(samples); });
    return std::move(out_);
  }

 private:
  void add(const char* method, OptionValues options, const Cost& cost, double error) {
    out_.push_back({method, std::move(options), cost.over(request_.frames) / request_.speed, error});
  }

  void add_silhouette(const LightFacts& facts, bool merges) {
    OptionValues options;
    if (!merges) options["silhouette-tolerance"] = 0.0;
    add("silhouette", std::move(options), cost_of_silhouette(facts, merges), error_of_silhouette(facts));
  }

  template <class Add>
  void for_fewer(int samples, const Add& add) const {
    constexpr int kLeast = 4;
    add(samples);
    if (!(request_.max_ms > 0.0)) return;
    while (samples > kLeast) add(samples = std::max(kLeast, samples / 4));
  }

  void add_rays(int samples, int up_to) {
    OptionValues options{{"samples", unsigned_of(samples)}};
    if (up_to > 0) options["areas-up-to"] = unsigned_of(up_to);
    add("rays", std::move(options), cost_of_rays(facts_, samples, up_to),
        error_of_rays(facts_, samples, up_to));
  }

  void add_reference(int samples) {
    add("reference", {{"samples", unsigned_of(samples)}}, cost_of_reference(facts_, samples),
        error_of_rays(facts_, samples));
  }

  const LightFacts& facts_;
  LightFacts unmerged_;
  const PlanRequest& request_;
  bool is_certified_, has_areas_;
  std::vector<Candidate> out_;
};

}  // namespace

std::vector<Candidate> candidates(const LightFacts& facts, const PlanRequest& request) {
  return Candidates(facts, request).all();
}

}  // namespace penumbra::detail
