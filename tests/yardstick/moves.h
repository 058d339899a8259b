// Scenes that are scaled, turned and moved: p becomes scale·R·p + shift, rounded.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "penumbra/render/scene/scene.h"

namespace penumbra::yardstick {

struct Move {
  double scale = 1.0;
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};
  Vec3 shift{0.0};

  Vec3 operator()(const Vec3& p) const { return scale * (turn * p) + shift; }
};

/// A turn by chance. The same seed gives the same.
glm::dquat turn_by_chance(std::uint64_t seed);

/// Everything in the scene: objects, lights, camera. Faces keep their numbers.
Scene moved(const Scene& scene, const Move& move);

}  // namespace penumbra::yardstick
