// What Casters holds: methods and rays that are made when they are first asked for.
#pragma once

#include <list>
#include <map>
#include <mutex>

#include "penumbra/render/visibility.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

struct Casters::Impl {
  Impl(std::vector<SceneObject> objects, int threads);

  /// Rays in the frame of this light. Those of the last `kept_frames` are kept; a reference holds until other
  /// frames have been asked for.
  const RayScene& rays_for(const LightShape& light);
  /// Rays in the frame that was asked for last, whatever the light: right but for their last digits, and at
  /// once. Those of the light where there are none yet.
  const RayScene& rays_near(const LightShape& light);
  /// The method of that name, made when it is first asked for.
  Method& method(const MethodInfo& info);
  void forget();

  Scene scene;  ///< objects alone
  detail::Threads threads;
  std::mutex mutex;  ///< held by a call
  /// Memory: what depends on a light's frame is kept for so many lights.
  std::size_t kept_frames = 2;

 private:
  std::list<RayScene> rays_;  ///< the last used first
  std::map<std::string, std::unique_ptr<Method>, std::less<>> methods_;
};

}  // namespace penumbra
