// How large and how far apart things may be.
//
// A scene may have any unit of length, and lights may be far away; but squares and cubes of coordinates must
// not overflow, and rays need some digits of the casters. Whatever is within these limits ends without a
// crash.
#pragma once

#include <string>

#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// No coordinate, length or other number of a scene is larger, in scene units.
inline constexpr double kMostNumber = 1e100;
/// Camera, lights and objects reach no farther from the middle of what casts than so many times its size
/// (half its longest side). A light that is farther is a distant one.
inline constexpr double kMostReach = 1e15;

/// What is too far away, as "/camera/eye: ...", with the limit and what to do; empty where nothing is. Cost
/// O(objects + lights).
std::string out_of_range(const Scene& scene);

}  // namespace penumbra::detail
