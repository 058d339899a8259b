#include "apps/python/python_surfaces.h"

namespace penumbra::python {
namespace {

constexpr std::uint32_t kGone = 0xFFFFFFFFu;

/// For each triangle that an object was given its face, kGone where it was left out.
std::vector<std::uint32_t> faces_by_triangle(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.triangles().size() + mesh.report().degenerate.size(), kGone);
  for (std::size_t f = 0; f < mesh.triangles().size(); ++f)
    faces[mesh.source_triangles()[f]] = static_cast<std::uint32_t>(f);
  return faces;
}

std::vector<std::int32_t> objects_of(const Scene& scene, const py::object& objects, const Shape& shape) {
  std::vector<std::int32_t> out;
  const auto count = static_cast<std::int64_t>(scene.objects.size());
  for (const std::int64_t object : integers_of(objects, "objects", shape)) {
    if (object < -1 || object >= count)
      throw py::value_error(place_of("objects", shape, out.size()) + " is " + std::to_string(object) +
                            ", but the scene has " + std::to_string(count) +
                            " objects, numbered from 0; -1 is no point");
    out.push_back(static_cast<std::int32_t>(object));
  }
  return out;
}

}  // namespace

PointArray normals_of(const py::object& normals, const PointArray& points) {
  PointArray out = points_of(normals, "normals");
  if (out.shape != points.shape)
    throw py::value_error("normals have shape " + text_of(shape_of(out.array)) + ", but points have " +
                          text_of(shape_of(points.array)) + "; give one for each point");
  return out;
}

Surfaces surfaces_of(const Scene& scene, const py::object& objects, const py::object& faces,
                     const Shape& shape) {
  if (objects.is_none() && faces.is_none()) return {};
  if (objects.is_none() && scene.objects.size() != 1)
    throw py::value_error("faces are given without objects, and the scene has " +
                          std::to_string(scene.objects.size()) + " objects; say on which one they are");
  Surfaces out;
  out.objects = objects_of(scene, objects.is_none() ? py::int_(0) : objects, shape);
  if (faces.is_none()) return out;
  std::vector<std::vector<std::uint32_t>> known(scene.objects.size());
  for (const std::int64_t triangle : integers_of(faces, "faces", shape)) {
    const std::size_t i = out.faces.size();
    if (out.objects[i] < 0) {
      out.faces.push_back(0);
      continue;
    }
    const auto object = static_cast<std::size_t>(out.objects[i]);
    if (known[object].empty()) known[object] = faces_by_triangle(scene.objects[object].mesh);
    const auto count = static_cast<std::int64_t>(known[object].size());
    if (triangle < 0 || triangle >= count)
      throw py::value_error(place_of("faces", shape, i) + " is " + std::to_string(triangle) +
                            ", but object " + std::to_string(object) + " has " + std::to_string(count) +
                            " triangles, numbered from 0");
    out.faces.push_back(known[object][static_cast<std::size_t>(triangle)]);
    if (out.faces.back() == kGone)
      throw py::value_error(place_of("faces", shape, i) + " is triangle " + std::to_string(triangle) +
                            " of object " + std::to_string(object) +
                            ", which has no three distinct corners; nothing lies on it");
  }
  return out;
}

}  // namespace penumbra::python
