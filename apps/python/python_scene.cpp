#include "apps/python/python_scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "penumbra/mesh/error.h"

namespace penumbra::python {
namespace {

// Of the product of the columns' lengths; a smaller determinant is that of a matrix which flattens.
constexpr double kFlat = 1e-12;

/// world = columns · p + translation.
struct Placement {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, translation{0.0};
  double determinant() const { return glm::dot(glm::cross(x, y), z); }
};

Placement placement_of(const py::object& matrix) {
  const py::array_t<double, py::array::c_style | py::array::forcecast> m(matrix);
  const Shape shape = shape_of(m);
  if (shape != Shape{4, 4} && shape != Shape{3, 4})
    throw py::value_error(
        "transform has shape " + text_of(shape) +
        "; give (4, 4) or (3, 4): rotation and scale in columns 0 to 2, translation in column 3");
  for (py::ssize_t i = 0; i < m.size(); ++i)
    if (!std::isfinite(m.data()[i])) throw py::value_error("transform is not finite; give finite numbers");
  const auto column = [&](py::ssize_t j) { return Vec3(m.at(0, j), m.at(1, j), m.at(2, j)); };
  const Placement out{column(0), column(1), column(2), column(3)};
  if (shape[0] == 4 && !(m.at(3, 0) == 0 && m.at(3, 1) == 0 && m.at(3, 2) == 0 && m.at(3, 3) == 1))
    throw py::value_error(
        "the last row of transform is not 0, 0, 0, 1: points are multiplied from the right, "
        "M @ p; transpose a matrix made for p @ M");
  if (!(std::abs(out.determinant()) > kFlat * glm::length(out.x) * glm::length(out.y) * glm::length(out.z)))
    throw py::value_error(
        "transform is singular: it flattens the mesh; use a matrix whose determinant is not 0");
  return out;
}

/// Moves the vertices, and turns the triangles where the matrix mirrors.
std::vector<Vec3> placed(std::span<const Vec3> points, const Placement& at,
                         std::vector<IndexedTriangle>& triangles) {
  std::vector<Vec3> out;
  out.reserve(points.size());
  for (const Vec3& p : points) out.push_back(at.x * p.x + at.y * p.y + at.z * p.z + at.translation);
  if (at.determinant() < 0.0)
    for (IndexedTriangle& t : triangles) std::swap(t[1], t[2]);
  return out;
}

}  // namespace

std::shared_ptr<PythonScene> PythonScene::from_file(const std::filesystem::path& path, int threads) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    PyErr_SetString(PyExc_FileNotFoundError, (path.string() + ": no such file; check the path").c_str());
    throw py::error_already_set();
  }
  LoadedScene loaded = [&] {
    const py::gil_scoped_release release;
    return load_scene(path);
  }();
  auto out = std::make_shared<PythonScene>(threads);
  out->scene_ = std::move(loaded.scene);
  out->warnings_ = std::move(loaded.warnings);
  out->has_camera_ = true;
  return out;
}

std::size_t PythonScene::add(const py::object& vertices, const py::object& triangles,
                             const py::object& transform, SceneObject object) {
  const PointArray rows = rows_of(vertices, "V");
  require_finite(rows, "V");
  std::vector<IndexedTriangle> faces = triangles_of(triangles, "F", rows.points.size());
  if (faces.empty())
    throw py::value_error("F has no rows; give at least one triangle (Scene() is a scene without objects)");
  std::vector<Vec3> moved;
  if (!transform.is_none()) moved = placed(rows.points, placement_of(transform), faces);
  {
    const py::gil_scoped_release release;
    object.mesh =
        TriangleMesh::build(transform.is_none() ? rows.points : std::span<const Vec3>(moved), faces);
  }
  if (object.mesh.empty())
    throw py::value_error("no row of F has three distinct corners; nothing is left of the mesh");
  scene_.objects.push_back(std::move(object));
  casters_.reset();
  return scene_.objects.size() - 1;
}

std::shared_ptr<const Casters> PythonScene::casters() {
  if (casters_) return casters_;
  std::vector<SceneObject> objects;
  for (const SceneObject& object : scene_.objects)
    objects.push_back({.name = object.name, .mesh = object.mesh, .casts = object.casts});
  return casters_ = std::make_shared<const Casters>(std::move(objects), threads_);
}

const SceneObject& PythonScene::object(std::ptrdiff_t i) const {
  const auto count = static_cast<std::ptrdiff_t>(scene_.objects.size());
  if (i < -count || i >= count)
    throw py::index_error("there is no object " + std::to_string(i) + "; the scene has " +
                          std::to_string(count) + ", numbered from 0");
  return scene_.objects[static_cast<std::size_t>(i < 0 ? i + count : i)];
}

void PythonScene::set_camera(const Camera& camera) {
  scene_.camera = camera;
  has_camera_ = true;
}

}  // namespace penumbra::python
