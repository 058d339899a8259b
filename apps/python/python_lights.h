// Lights as Python has them: objects that do not change.
#pragma once

#include <pybind11/pybind11.h>

#include "penumbra/render/scene/scene.h"

namespace penumbra::python {

namespace py = pybind11;

// One type for each kind, so that Python has a class for each.
struct PythonDisk : Light {};
struct PythonDistant : Light {};
struct PythonRectangle : Light {};

py::object python_light(const Light& light);

/// A light, or the number or name of one of the scene's. Throws TypeError, UsageError.
const LightShape& light_of(const Scene& scene, const py::object& light);

}  // namespace penumbra::python
