// What Casters holds: methods and rays that are made when they are first asked for.
#pragma once

#include <map>
#include <mutex>
#include <optional>

#include "penumbra/render/visibility.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

struct Casters::Impl {
  Impl(std::vector<SceneObject> objects, int threads);

  /// Rays among the objects, for every light; made when they are first asked for.
  const RayScene& rays();
  /// The method of that name, made when it is first asked for.
  Method& method(const MethodInfo& info);
  void forget();

  Scene scene;  ///< objects alone
  detail::Threads threads;
  std::mutex mutex;  ///< held by a call

 private:
  std::optional<RayScene> rays_;
  std::map<std::string, std::unique_ptr<Method>, std::less<>> methods_;
};

}  // namespace penumbra
