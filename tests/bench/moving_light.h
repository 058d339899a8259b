// The light of a scene on its way, for benchmarks of frames that follow each other.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "penumbra/render/scene/scene.h"

namespace penumbra::bench {

/// The disk on a circle in its own plane, of a tenth of its distance from the origin, in so many steps.
inline Light moved(const Light& from, int step, int steps) {
  Light light = from;
  auto& disk = std::get<DiskLight>(light.shape);
  const LightFrame axes = light_frame(disk);
  const double radius = 0.1 * glm::length(disk.center), angle = 2.0 * std::numbers::pi * step / steps;
  disk.center += radius * (std::cos(angle) * axes.u + std::sin(angle) * axes.v);
  return light;
}

}  // namespace penumbra::bench
