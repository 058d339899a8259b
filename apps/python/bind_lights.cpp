// DiskLight, DistantLight, RectangleLight.
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/python_lights.h"
#include "penumbra/mesh/error.h"
#include "render/light/valid_light.h"
#include "render/scene/scene_lights.h"
#include "render/scene/scene_limits.h"

namespace penumbra::python {
namespace {

/// One number, or three.
Vec3 color_of(const py::object& color, const char* name) {
  if (PyFloat_Check(color.ptr()) || PyLong_Check(color.ptr())) return Vec3(color.cast<double>());
  return vector_of(color, name);
}

template <class T>
T made(std::string name, LightShape shape, const py::object& radiance) {
  require_valid(shape);
  if (!name.empty() && !penumbra::detail::is_light_name(name))
    throw UsageError("the name \"" + name + "\" is not of letters, digits, '-' and '_', at most 200");
  T light;
  light.name = std::move(name);
  light.shape = shape;
  light.radiance = color_of(radiance, "radiance");
  for (int k = 0; k < 3; ++k)
    if (!(light.radiance[k] >= 0.0 && light.radiance[k] <= penumbra::detail::kMostNumber))
      throw UsageError("radiance is not from 0 to 1e100");
  return light;
}

template <class Shape>
const Shape& as(const Light& light) {
  return std::get<Shape>(light.shape);
}

std::string written(const Vec3& v) {
  return py::str(tuple_of(v));
}

void bind_disk(py::module_& module) {
  py::class_<PythonDisk, Light>(
      module, "DiskLight",
      R"(A flat disk that shines on the side of its normal; nothing behind its plane is lit.

center: 3 numbers, scene units. normal: where it shines to, any length but 0. radius: scene units; 0 is a point light.
radiance: one number or linear RGB, W/(m² sr); only pictures depend on it. name: of letters, digits, '-' and '_', at most 200.)")
      .def(py::init([](const py::object& center, const py::object& normal, double radius,
                       const py::object& radiance, const std::string& name) {
             return made<PythonDisk>(
                 name, DiskLight{vector_of(center, "center"), vector_of(normal, "normal"), radius}, radiance);
           }),
           py::arg("center"), py::arg("normal"), py::arg("radius"), py::kw_only(), py::arg("radiance") = 10.0,
           py::arg("name") = "")
      .def_property_readonly("center", [](const PythonDisk& l) { return tuple_of(as<DiskLight>(l).center); })
      .def_property_readonly("normal", [](const PythonDisk& l) { return tuple_of(as<DiskLight>(l).normal); })
      .def_property_readonly("radius", [](const PythonDisk& l) { return as<DiskLight>(l).radius; })
      .def("__repr__", [](const PythonDisk& l) {
        const auto& disk = as<DiskLight>(l);
        return "DiskLight(center=" + written(disk.center) + ", normal=" + written(disk.normal) +
               ", radius=" + std::string(py::repr(py::float_(disk.radius))) + ")";
      });
}

void bind_distant(py::module_& module) {
  py::class_<PythonDistant, Light>(module, "DistantLight",
                                   R"(A disk at infinity, such as the sun.

direction: in which it shines, 3 numbers, any length but 0. angle_degrees: the angle that the whole disk fills, 0 to below
180; the sun's is 0.53. radiance, name: as of DiskLight.)")
      .def(py::init([](const py::object& direction, double angle, const py::object& radiance,
                       const std::string& name) {
             return made<PythonDistant>(name, DistantLight{vector_of(direction, "direction"), angle},
                                        radiance);
           }),
           py::arg("direction"), py::arg("angle_degrees") = 0.53, py::kw_only(), py::arg("radiance") = 10.0,
           py::arg("name") = "")
      .def_property_readonly("direction",
                             [](const PythonDistant& l) { return tuple_of(as<DistantLight>(l).direction); })
      .def_property_readonly("angle_degrees",
                             [](const PythonDistant& l) { return as<DistantLight>(l).angle_degrees; })
      .def("__repr__", [](const PythonDistant& l) {
        const auto& sun = as<DistantLight>(l);
        return "DistantLight(direction=" + written(sun.direction) +
               ", angle_degrees=" + std::string(py::repr(py::float_(sun.angle_degrees))) + ")";
      });
}

void bind_rectangle(py::module_& module) {
  py::class_<PythonRectangle, Light>(
      module, "RectangleLight",
      R"(A flat rectangle that shines on the side of its normal; for the methods 'reference' and 'hard'.

center: 3 numbers, scene units. normal: where it shines to. tangent: along one pair of sides; only its part in the light's
plane counts. half_extents: half the sides' lengths along the tangent and across it, scene units. radiance, name: as of
DiskLight.)")
      .def(py::init([](const py::object& center, const py::object& normal, const py::object& tangent,
                       const std::pair<double, double>& half, const py::object& radiance,
                       const std::string& name) {
             return made<PythonRectangle>(name,
                                          RectangleLight{vector_of(center, "center"),
                                                         vector_of(normal, "normal"),
                                                         vector_of(tangent, "tangent"),
                                                         {half.first, half.second}},
                                          radiance);
           }),
           py::arg("center"), py::arg("normal"), py::arg("tangent"), py::arg("half_extents"), py::kw_only(),
           py::arg("radiance") = 10.0, py::arg("name") = "")
      .def_property_readonly("center",
                             [](const PythonRectangle& l) { return tuple_of(as<RectangleLight>(l).center); })
      .def_property_readonly("normal",
                             [](const PythonRectangle& l) { return tuple_of(as<RectangleLight>(l).normal); })
      .def_property_readonly("tangent",
                             [](const PythonRectangle& l) { return tuple_of(as<RectangleLight>(l).tangent); })
      .def_property_readonly("half_extents", [](const PythonRectangle& l) {
        const glm::dvec2& half = as<RectangleLight>(l).half_extents;
        return py::make_tuple(half.x, half.y);
      });
}

}  // namespace

py::object python_light(const Light& light) {
  if (std::holds_alternative<DiskLight>(light.shape)) return py::cast(PythonDisk{light});
  if (std::holds_alternative<DistantLight>(light.shape)) return py::cast(PythonDistant{light});
  return py::cast(PythonRectangle{light});
}

const LightShape& light_of(const Scene& scene, const py::object& light) {
  if (py::isinstance<Light>(light)) return light.cast<const Light&>().shape;
  if (py::isinstance<py::str>(light) || PyIndex_Check(light.ptr())) {
    if (scene.lights.empty())
      throw py::value_error(
          "light is " + std::string(py::repr(light)) +
          ", but the scene has no lights; give a DiskLight or DistantLight, or set scene.lights");
    return scene.lights[scene.light_index(std::string(py::str(light)))].shape;
  }
  throw py::type_error(
      "light is " + std::string(py::str(py::type::of(light))) +
      "; give a DiskLight, DistantLight or RectangleLight, or the number or name of one of the scene's");
}

void bind_lights(py::module_& module) {
  py::class_<Light>(module, "Light",
                    "What all lights have. Make a DiskLight, a DistantLight or a RectangleLight.")
      .def_property_readonly("name", [](const Light& light) { return light.name; })
      .def_property_readonly("radiance", [](const Light& light) { return tuple_of(light.radiance); })
      .def(
          "__eq__",
          [](const Light& light, const py::object& other) {
            return py::isinstance<Light>(other) && light == other.cast<const Light&>();
          },
          py::arg("other"));
  bind_disk(module);
  bind_distant(module);
  bind_rectangle(module);
}

}  // namespace penumbra::python
