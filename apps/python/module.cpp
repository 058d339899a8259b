// The Python module: exceptions, then all parts.
#include "apps/python/bindings.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"

namespace penumbra::python {
namespace {

void throw_as(PyObject* type, const std::exception& e) {
  PyErr_SetString(type, e.what());
}

void bind_exceptions(py::module_& module) {
  // Those registered last are asked first, and the base of all would catch any.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const UsageError& e) {
      throw_as(PyExc_ValueError, e);
    } catch (const SystemError& e) {
      throw_as(PyExc_OSError, e);
    }
  });
  py::register_exception<MeshError>(module, "MeshError", PyExc_ValueError).doc() =
      "A mesh that cannot be used: a file that cannot be read, coordinates that are not finite.";
  py::register_exception<SceneError>(module, "SceneError", PyExc_ValueError).doc() =
      "A scene that cannot be used: wrong keys, negative radius, singular matrix.";
  py::register_exception<Cancelled>(module, "Cancelled", PyExc_RuntimeError).doc() =
      "The callable that watches a long call returned False.";
}

}  // namespace
}  // namespace penumbra::python

PYBIND11_MODULE(_penumbra, module) {
  using namespace penumbra::python;
  module.attr("__name__") = "penumbra";  // where users find what is bound
  module.attr("__version__") = PENUMBRA_VERSION;
  penumbra::register_drawing_methods();  // now, while no other thread uses the list of methods
  bind_exceptions(module);
  bind_lights(module);
  SceneClass scene = bind_scene(module);
  bind_visibility(scene);
  bind_sun(module, scene);
  bind_solids(module);
  bind_silhouettes(module);
  bind_render(module);
}
