// Method soft-shadow-volumes: how many faces a ray meets, object by object.
#pragma once

#include <vector>

#include "render/rays/ray_packets.h"

namespace penumbra::detail {

/// Of each of `objects` objects the faces of casters that the ray meets. Two faces with a common edge count
/// as one where the ray meets that edge. Cost O(log faces) a face that is met; at most 1,000 are counted.
std::vector<std::size_t> faces_met(Ray ray, const RayScene& rays, std::size_t objects);

/// The layers that the ray passes; `layers`: of one face, one an object. Not more than `enough` or a little
/// more are counted.
double layers_passed(Ray ray, const RayScene& rays, const std::vector<double>& layers, double enough);

}  // namespace penumbra::detail
