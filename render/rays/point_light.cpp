#include "render/rays/point_light.h"

#include <numeric>

#include "penumbra/mesh/stage_clock.h"
#include "render/rays/hard.h"

namespace penumbra {

MethodResult hard_shadow(const MethodInput& input) {
  StageClock clock;
  std::vector<std::uint32_t> indices(input.receivers.size());
  std::iota(indices.begin(), indices.end(), 0u);
  ReferenceResult traced = trace_hard(input.rays, input.light, input.receivers, indices);
  MethodResult out;
  if (input.with_unoccluded)
    out.unoccluded = trace_hard(input.rays, input.light, input.receivers, indices, false).visibility;
  clock.finish("visibility");
  out.visibility = std::move(traced.visibility);
  out.stages = clock.stages();
  out.counts = {{"rays", traced.rays}};
  return out;
}

}  // namespace penumbra
