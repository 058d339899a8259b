// The parts of the module `penumbra`, each in a file of its own. A part's types are bound before those that
// use them.
#pragma once

#include <pybind11/pybind11.h>

#include "apps/python/python_scene.h"

namespace penumbra::python {

void bind_lights(py::module_& module);
/// Camera and Scene; further methods of Scene are bound by the parts below.
using SceneClass = py::class_<PythonScene, std::shared_ptr<PythonScene>>;
SceneClass bind_scene(py::module_& module);
void bind_visibility(SceneClass& scene);
void bind_sun(py::module_& module, SceneClass& scene);
void bind_solids(py::module_& module);
void bind_silhouettes(py::module_& module);
void bind_render(py::module_& module);

}  // namespace penumbra::python
