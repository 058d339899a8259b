// render: a picture's channels as arrays (render/renderer.h).
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/bindings.h"
#include "apps/python/long_call.h"
#include "apps/python/python_options.h"
#include "penumbra/render/renderer.h"

namespace penumbra::python {
namespace {

std::shared_ptr<PythonScene> scene_of(const py::object& scene) {
  if (py::isinstance<PythonScene>(scene)) return scene.cast<std::shared_ptr<PythonScene>>();
  if (!py::isinstance<py::str>(scene) && !py::hasattr(scene, "__fspath__"))
    throw py::type_error("scene is " + std::string(py::str(py::type::of(scene))) +
                         "; give a Scene or the path of a scene or mesh file");
  return PythonScene::from_file(scene.cast<std::filesystem::path>(), 0);
}

py::dict stats_of(const RenderResult& result) {
  py::dict stats;
  stats["method"] = result.method;
  stats["options"] = dict_of(result.options);
  stats["frame_ms"] = result.frame_ms;
  stats["milliseconds"] = dict_of(result.stages);
  stats["setup_milliseconds"] = dict_of(result.setup);
  py::list lights;
  for (const MethodFrame& frame : result.lights) {
    py::dict light;
    light["name"] = frame.light;
    light["counts"] = dict_of(frame.counts);
    light["decisions"] = list_of(frame.decisions);
    lights.append(light);
  }
  stats["lights"] = lights;
  stats["warnings"] = result.warnings;
  return stats;
}

py::object picture_of(const py::object& of, const py::object& method, const std::pair<int, int>& size,
                      const py::object& antialias, const py::object& max_error, bool stats,
                      const py::object& progress, const py::kwargs& options) {
  const std::shared_ptr<PythonScene> from = scene_of(of);
  const MethodChoice choice = choice_of(method, max_error, options);
  if (!from->has_camera())
    throw py::value_error("the scene has no camera; set scene.camera = penumbra.Camera(eye, target)");
  if (from->scene().lights.empty())
    throw py::value_error("the scene has no light; set scene.lights = [penumbra.DiskLight(...)]");
  const Scene scene = from->scene();
  RenderOptions wanted{.method = choice.method,
                       .options = choice.options,
                       .width = size.first,
                       .height = size.second,
                       .antialias = antialias.is_none() ? scene.picture.antialias : antialias.cast<int>()};
  RenderResult result = long_call(progress, [&](const Progress& report) {
    wanted.progress = report;
    return render(scene, wanted, from->threads());
  });
  py::dict channels;
  for (auto& [name, values] : result.image.channels)
    channels[py::str(name)] = owned<float>(std::move(values), {result.image.height, result.image.width});
  if (!stats) return channels;
  return py::make_tuple(channels, stats_of(result));
}

}  // namespace

void bind_render(py::module_& module) {
  module.def("render", &picture_of, py::arg("scene"), py::arg("method") = py::none(), py::kw_only(),
             py::arg("size") = py::make_tuple(640, 480), py::arg("antialias") = py::none(),
             py::arg("max_error") = py::none(), py::arg("stats") = false, py::arg("progress") = py::none(),
             R"(A picture of a scene, as arrays.

scene: a Scene that has lights and a camera, or the path of a scene or mesh file. method, max_error, progress and further keywords:
as of Scene.visibility; 'dbuffer' and 'occlusion-textures' draw by OpenGL. size: width and height in pixels. antialias: so many
samples along each side of a pixel, 1 to 16; None: as the scene asks.

Returns a dict of float32 arrays of shape (height, width), row 0 at the top: R, G, B (linear, multiplied by A) and A, which is 0 where
no surface is; visibility and region (visibility.NAME and region.NAME of several lights); object (its number, -1 none); P.X, P.Y,
P.Z in scene units; N.X, N.Y, N.Z. With stats also a dict of milliseconds, counts and decisions.)");
}

}  // namespace penumbra::python
