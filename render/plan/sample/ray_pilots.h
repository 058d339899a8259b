// Planner, step measure: receivers in penumbra, and two independent estimates by rays at each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "render/plan/sample/ray_error.h"
#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"

namespace penumbra::detail {

/// What 16 rays tell of some receivers.
struct Seen {
  std::vector<std::uint32_t> lit, partly, hidden;
};
Seen see_with_few_rays(const RayScene& rays, const LightShape& light, const Receivers& receivers,
                       std::span<const std::uint32_t> some);

/// A receiver that 16 rays find partly lit, and which of the first ones it is or lies beside.
struct PartlyLit {
  std::uint32_t index, group;
};

/// All of `partly`. Where these are fewer than `wanted` also four pixels near each that 16 rays find partly
/// lit: what lies beside penumbra mostly is penumbra, so these cost fewer rays than a search. Together as
/// many as wanted, about. One group after another.
std::vector<PartlyLit> with_neighbors(const RayScene& rays, const LightShape& light,
                                      const Receivers& receivers, std::span<const std::uint32_t> partly,
                                      std::size_t wanted);

/// Two independent estimates at each of some of these.
class Twice {
 public:
  Twice(const RayScene& rays, const LightShape& light, const Receivers& receivers,
        std::span<const PartlyLit> some, int samples, std::uint64_t seed);

  int samples() const { return first_.samples; }
  /// O, about.
  double open(std::size_t i) const;
  /// The first rays miss a receiver of which little is open or little is hidden. It stands for all that they
  /// find with its probability.
  double weight(std::size_t i) const;
  /// Without bias: of V (1 - V), and of the squared error of one estimate.
  double variance(std::size_t i) const;
  double error2(std::size_t i) const;

 private:
  ReferenceResult first_, second_;
};

/// Numbers of the penumbra by the first pilot, one of as many receivers as the first rays found partly lit.
struct FirstLook {
  FirstLook(const Twice& seen, std::span<const PartlyLit> some, std::size_t found);

  /// Receivers that the first rays found lit or hidden though they are partly lit, about.
  double missed_lit = 0.0, missed_hidden = 0.0;
  /// As in SampledFacts.
  double variance, boundary;
};

}  // namespace penumbra::detail
