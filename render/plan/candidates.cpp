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
    merges_ = effects.merging != EffectChoice::kOff;
    if (merges_) return;
    for (SampledPart* part : {&facts_.sampled.lit, &facts_.sampled.penumbra, &facts_.sampled.hidden})
      part->merged_edges = part->edges;
  }

  /// With as many rays and rows as the error asks for, and with fewer where time is limited.
  std::vector<Candidate> all() {
    constexpr int kLeast = 4;
    if (has_areas_) add_silhouettes();
    if (request_.effects.areas == EffectChoice::kOn) return std::move(out_);
    int samples = rays_for(facts_, request_.max_error);
    add_rays(samples);
    for (; request_.max_ms > 0.0 && samples > kLeast; samples = std::max(kLeast, samples / 4))
      add_rays(std::max(kLeast, samples / 4));
    return std::move(out_);
  }

 private:
  void add(const char* method, OptionValues options, const Cost& cost, double error) {
    out_.push_back({method, std::move(options), cost.over(request_.frames) / request_.speed, error});
  }

  void add_silhouettes() {
    for (const int rows : silhouette_rows()) {
      OptionValues options;
      if (rows != kUsualRows) options["silhouette-rows"] = unsigned_of(rows);
      if (!merges_) options["silhouette-tolerance"] = 0.0;
      add("silhouette", std::move(options), cost_of_silhouette(facts_, rows),
          error_of_silhouette(facts_, rows));
    }
  }

  void add_rays(int samples) {
    const double error = error_of_rays(facts_, samples);
    // Certificates are of V: rays that have them do not give O.
    if (is_certified_ && !request_.with_unoccluded) {
      OptionValues options{{"samples", unsigned_of(samples)}};
      const int up_to = has_areas_ && merges_ ? areas_up_to(facts_, samples) : 0;
      if (up_to > 0) options["areas-up-to"] = unsigned_of(up_to);
      add("rays", std::move(options), cost_of_rays(facts_, samples, up_to), error);
    }
    if (request_.effects.certificates != EffectChoice::kOn)
      add("reference", {{"samples", unsigned_of(samples)}}, cost_of_reference(facts_, samples), error);
  }

  LightFacts facts_;
  const PlanRequest& request_;
  bool is_certified_, has_areas_, merges_;
  std::vector<Candidate> out_;
};

}  // namespace

std::vector<Candidate> candidates(const LightFacts& facts, const PlanRequest& request) {
  return Candidates(facts, request).all();
}

}  // namespace penumbra::detail
