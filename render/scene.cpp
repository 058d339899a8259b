#include "render/scene.h"

namespace penumbra {

Bounds Scene::bounds() const {
  Bounds bounds;
  for (const SceneObject& object : objects) bounds.add(bounds_of(object.mesh.positions()));
  return bounds;
}

Bounds Scene::caster_bounds() const {
  Bounds bounds;
  for (const SceneObject& object : objects)
    if (object.casts) bounds.add(bounds_of(object.mesh.positions()));
  return bounds;
}

}  // namespace penumbra
