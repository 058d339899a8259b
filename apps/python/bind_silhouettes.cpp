// classify, silhouettes: what faces and edges are to a light (volumes/classify.h, volumes/silhouettes.h).
#include "apps/python/bindings.h"
#include "apps/python/python_lights.h"
#include "penumbra/volumes/silhouettes.h"
#include "penumbra/volumes/volumes.h"

namespace penumbra::python {
namespace {

CircularLight circular(const PythonScene& scene, const py::object& light, const char* who) {
  const CircularLight out = require_circular(light_of(scene.scene(), light), who);
  require_valid(out);
  return out;
}

py::array classes_of(const PythonScene& scene, const py::object& light, std::ptrdiff_t object) {
  const TriangleMesh mesh = scene.object(object).mesh;  // shared, so that it stays
  const CircularLight of = circular(scene, light, "classify");
  std::vector<std::int8_t> classes(mesh.triangles().size() + mesh.report().degenerate.size(), -1);
  {
    const py::gil_scoped_release release;
    const Classification found = classify_faces(mesh, of);
    for (std::size_t f = 0; f < found.faces.size(); ++f)
      classes[mesh.source_triangles()[f]] = static_cast<std::int8_t>(found.faces[f]);
  }
  const auto count = static_cast<py::ssize_t>(classes.size());
  return owned<std::int8_t>(std::move(classes), {count});
}

py::array edges_of(const TriangleMesh& mesh, const std::vector<EdgeId>& edges) {
  std::vector<std::array<std::uint32_t, 2>> ends;
  ends.reserve(edges.size());
  for (const EdgeId id : edges) {
    const Edge& edge = mesh.edges()[index(id)];
    ends.push_back(
        {static_cast<std::uint32_t>(index(edge.from)), static_cast<std::uint32_t>(index(edge.to))});
  }
  return owned_rows(std::move(ends));
}

py::dict silhouettes_of(const PythonScene& scene, const py::object& light, std::ptrdiff_t object) {
  const TriangleMesh mesh = scene.object(object).mesh;
  const CircularLight of = circular(scene, light, "silhouettes");
  const Silhouettes found = [&] {
    const py::gil_scoped_release release;
    return find_silhouettes(mesh, classify_faces(mesh, of));
  }();
  py::dict out;
  out["vertices"] = owned_rows(std::vector<Vec3>(mesh.positions().begin(), mesh.positions().end()));
  out["umbra"] = edges_of(mesh, found.umbra);
  out["penumbra"] = edges_of(mesh, found.penumbra);
  out["band"] = edges_of(mesh, found.band);
  return out;
}

}  // namespace

void bind_silhouettes(py::module_& module) {
  module.def("classify", &classes_of, py::arg("scene"), py::arg("light"), py::arg("object") = 0,
             R"(How each triangle of an object looks at a disk or a distant light, decided exactly.

Returns int8 (m,), one a row of the object's F: 2 where the whole disk is strictly in front of the triangle's plane, 0 where it is
strictly behind, 1 else; -1 for a triangle without three distinct corners.)");
  module.def("silhouettes", &silhouettes_of, py::arg("scene"), py::arg("light"), py::arg("object") = 0,
             R"(The edges of an object that bound its shadow.

Returns a dict: vertices (n, 3) float64, scene units; umbra, penumbra and band (k, 2) uint32, rows of vertices. umbra: between a
triangle of class 0 (see classify) and one that is not. penumbra: between one of class 2 and one that is not. band: all edges but those
between two of class 0 or two of class 2; only they can be a silhouette for some point.)");
}

}  // namespace penumbra::python
