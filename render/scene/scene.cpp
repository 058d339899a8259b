#include "penumbra/render/scene/scene.h"

namespace penumbra {

Bounds Scene::bounds() const {
  Bounds bounds;
  for (const SceneObject& object : objects) bounds.add(object.mesh.bounds());
  return bounds;
}

Bounds Scene::caster_bounds() const {
  Bounds bounds;
  for (const SceneObject& object : objects)
    if (object.casts) bounds.add(object.mesh.bounds());
  return bounds;
}

}  // namespace penumbra
