// Camera and Scene: what casts, and what pictures need.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/bindings.h"
#include "apps/python/python_lights.h"
#include "penumbra/mesh/error.h"
#include "render/scene/scene_lights.h"

namespace penumbra::python {
namespace {

std::size_t add(PythonScene& scene, const py::object& vertices, const py::object& triangles,
                const py::object& transform, bool casts, const py::object& albedo, const std::string& name) {
  const bool gray = PyFloat_Check(albedo.ptr()) || PyLong_Check(albedo.ptr());
  const Vec3 color = gray ? Vec3(albedo.cast<double>()) : vector_of(albedo, "albedo");
  for (int k = 0; k < 3; ++k)
    if (!(color[k] >= 0.0 && color[k] <= 1.0)) throw UsageError("albedo is not between 0 and 1");
  return scene.add(vertices, triangles, transform, {.name = name, .albedo = color, .casts = casts});
}

py::tuple mesh_of(const PythonScene& scene, std::ptrdiff_t object) {
  const TriangleMesh& mesh = scene.object(object).mesh;
  return py::make_tuple(
      owned_rows(std::vector<Vec3>(mesh.positions().begin(), mesh.positions().end())),
      owned_rows(std::vector<IndexedTriangle>(mesh.triangles().begin(), mesh.triangles().end())));
}

py::object bounds_of(const PythonScene& scene) {
  const Bounds bounds = scene.scene().bounds();
  if (bounds.empty()) return py::none();
  return owned_rows(std::vector<Vec3>{bounds.low, bounds.high});
}

py::list lights_of(const PythonScene& scene) {
  py::list lights;
  for (const Light& light : scene.scene().lights) lights.append(python_light(light));
  return lights;
}

void bind_camera(py::module_& module) {
  py::class_<Camera>(module, "Camera", R"(A pinhole with square pixels.

eye, target: 3 numbers each, scene units. up: any vector not parallel to the line of sight. fov_y_degrees: vertical field of
view, above 0 and below 180.)")
      .def(
          py::init([](const py::object& eye, const py::object& target, const py::object& up, double fov) {
            if (!(fov > 0.0 && fov < 180.0))
              throw UsageError("fov_y_degrees is not between 0 and 180 degrees");
            const Camera camera{vector_of(eye, "eye"), vector_of(target, "target"), vector_of(up, "up"), fov};
            if (penumbra::detail::are_parallel(camera.up, camera.target - camera.eye))
              throw UsageError("eye equals target, or up is 0 or parallel to the line of sight");
            return camera;
          }),
          py::arg("eye"), py::arg("target"), py::arg("up") = py::make_tuple(0.0, 1.0, 0.0),
          py::arg("fov_y_degrees") = 40.0)
      .def_property_readonly("eye", [](const Camera& c) { return tuple_of(c.eye); })
      .def_property_readonly("target", [](const Camera& c) { return tuple_of(c.target); })
      .def_property_readonly("up", [](const Camera& c) { return tuple_of(c.up); })
      .def_readonly("fov_y_degrees", &Camera::fov_y_degrees);
}

void bind_making(SceneClass& scene) {
  scene
      .def(py::init([](const py::object& vertices, const py::object& triangles, int threads) {
             if (vertices.is_none() != triangles.is_none())
               throw py::value_error("give both V and F, or neither");
             auto made = std::make_shared<PythonScene>(threads);
             if (!vertices.is_none()) made->add(vertices, triangles, py::none(), {});
             return made;
           }),
           py::arg("V") = py::none(), py::arg("F") = py::none(), py::kw_only(), py::arg("threads") = 0)
      .def_static("from_file", &PythonScene::from_file, py::arg("path"), py::kw_only(),
                  py::arg("threads") = 0,
                  R"(Reads a scene file (JSON) or a bare mesh (OBJ, PLY, OFF, STL).

A bare mesh becomes object 1; object 0 is a floor below it that does not cast, and there are a light and a camera.)")
      .def("add", &add, py::arg("V"), py::arg("F"), py::arg("transform") = py::none(), py::kw_only(),
           py::arg("casts") = true, py::arg("albedo") = 0.8, py::arg("name") = "",
           R"(Adds an object and returns its number.

V: (n, 3) real, scene units. F: (m, 3) integers, counter-clockwise seen from outside. transform: (4, 4) or (3, 4), applied as
M @ (x, y, z, 1). casts: whether it hides lights. albedo: one number or linear RGB, for pictures.)");
}

void bind_looking(SceneClass& scene) {
  scene.def("__len__", [](const PythonScene& s) { return s.scene().objects.size(); })
      .def("__repr__",
           [](const PythonScene& s) {
             std::size_t faces = 0;
             for (const SceneObject& object : s.scene().objects) faces += object.mesh.triangles().size();
             return "<penumbra.Scene of " + std::to_string(s.scene().objects.size()) + " objects, " +
                    std::to_string(faces) + " triangles, " + std::to_string(s.scene().lights.size()) +
                    " lights>";
           })
      .def("mesh", &mesh_of, py::arg("object") = 0,
           "V (n, 3) float64 and F (m, 3) uint32 of an object, in the world, as they were built: equal "
           "vertices are one, "
           "triangles without three corners are left out.")
      .def_property_readonly("bounds", &bounds_of,
                             "(2, 3) float64: lowest and highest corner of all objects, or None.")
      .def_property_readonly(
          "warnings", [](const PythonScene& s) { return s.warnings(); },
          "What reading the file left out or changed, one line each.")
      .def_property(
          "lights", &lights_of,
          [](PythonScene& s, const std::vector<Light*>& lights) {
            std::vector<Light> copies;
            for (const Light* light : lights) {
              if (!light) throw py::type_error("lights holds None; give lights");
              copies.push_back(*light);
            }
            s.set_lights(std::move(copies));
          },
          "The lights of pictures, a list; assign a new list to change them.")
      .def_property(
          "camera",
          [](const PythonScene& s) { return s.has_camera() ? py::cast(s.scene().camera) : py::none(); },
          &PythonScene::set_camera, "The camera of pictures, or None.");
}

}  // namespace

SceneClass bind_scene(py::module_& module) {
  bind_camera(module);
  SceneClass scene(module, "Scene", R"(Triangles that hide light.

Scene() has none, Scene(V, F) one object: V (n, 3) float64 or float32, scene units; F (m, 3) integers. Further ones are added by
add(). threads: how many calls use; 0: all cores. Hierarchies are made by the first call that needs them and kept until an
object is added.)");
  bind_making(scene);
  bind_looking(scene);
  return scene;
}

}  // namespace penumbra::python
