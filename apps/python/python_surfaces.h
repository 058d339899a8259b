// On which surfaces points lie, as Python says it: objects, rows of F, normals.
#pragma once

#include "apps/python/arrays.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::python {

/// The surfaces on which the points lie, in the library's terms.
struct Surfaces {
  std::vector<std::int32_t> objects;
  std::vector<std::uint32_t> faces;
};

/// Of points of that shape. Both empty where nothing is given. Throws ValueError, TypeError.
Surfaces surfaces_of(const Scene& scene, const py::object& objects, const py::object& faces,
                     const Shape& shape);

/// Throws ValueError unless there is one for each point.
PointArray normals_of(const py::object& normals, const PointArray& points);

}  // namespace penumbra::python
