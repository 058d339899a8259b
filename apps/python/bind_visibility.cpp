// Scene.visibility: the one call for visibility (render/visibility.h), on arrays.
#include "apps/python/bindings.h"
#include "apps/python/long_call.h"
#include "apps/python/python_lights.h"
#include "apps/python/python_options.h"
#include "penumbra/mesh/error.h"

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

/// The surfaces on which the points lie, in the library's terms.
struct Surfaces {
  std::vector<std::int32_t> objects;
  std::vector<std::uint32_t> faces;
};

std::vector<std::int32_t> objects_of(const PythonScene& scene, const py::object& objects,
                                     const Shape& shape) {
  std::vector<std::int32_t> out;
  const auto count = static_cast<std::int64_t>(scene.scene().objects.size());
  for (const std::int64_t object : integers_of(objects, "objects", shape)) {
    if (object < -1 || object >= count)
      throw py::value_error(place_of("objects", shape, out.size()) + " is " + std::to_string(object) +
                            ", but the scene has " + std::to_string(count) +
                            " objects, numbered from 0; -1 is no point");
    out.push_back(static_cast<std::int32_t>(object));
  }
  return out;
}

Surfaces surfaces_of(const PythonScene& scene, const py::object& objects, const py::object& faces,
                     const Shape& shape) {
  if (objects.is_none() && faces.is_none()) return {};
  if (objects.is_none() && scene.scene().objects.size() != 1)
    throw py::value_error("faces are given without objects, and the scene has " +
                          std::to_string(scene.scene().objects.size()) +
                          " objects; say on which one they are");
  Surfaces out;
  out.objects = objects_of(scene, objects.is_none() ? py::int_(0) : objects, shape);
  if (faces.is_none()) return out;
  std::vector<std::vector<std::uint32_t>> known(scene.scene().objects.size());
  for (const std::int64_t triangle : integers_of(faces, "faces", shape)) {
    const std::size_t i = out.faces.size();
    if (out.objects[i] < 0) {
      out.faces.push_back(0);
      continue;
    }
    const auto object = static_cast<std::size_t>(out.objects[i]);
    if (known[object].empty()) known[object] = faces_by_triangle(scene.scene().objects[object].mesh);
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

py::dict stats_of(const std::string& method, const OptionValues& options, const MethodResult& result) {
  py::dict stats;
  stats["method"] = method;
  stats["options"] = dict_of(completed(method_named(method).options, options));
  stats["milliseconds"] = dict_of(result.stages);
  stats["setup_milliseconds"] = dict_of(result.setup);
  stats["counts"] = dict_of(result.counts);
  stats["decisions"] = list_of(result.decisions);
  return stats;
}

py::object visibility_of(PythonScene& scene, const py::object& points, const py::object& light,
                         const py::object& normals, const py::object& method, const py::object& max_error,
                         bool region, bool stats, const py::object& objects, const py::object& faces,
                         const py::object& progress, const py::kwargs& options) {
  const PointArray at = points_of(points, "points");
  PointArray up;
  if (!normals.is_none()) {
    up = points_of(normals, "normals");
    if (up.shape != at.shape)
      throw py::value_error("normals have shape " + text_of(shape_of(up.array)) + ", but points have " +
                            text_of(shape_of(at.array)) + "; give one for each point");
  }
  const Surfaces on = surfaces_of(scene, objects, faces, at.shape);
  const MethodChoice choice = choice_of(method, max_error, options);
  const LightShape shape = light_of(scene.scene(), light);
  const auto casters = scene.casters();
  const Receivers receivers{
      .points = at.points, .normals = up.points, .objects = on.objects, .faces = on.faces};
  if (region && !method_named(choice.method).certifies)
    throw py::value_error("method '" + choice.method + "' certifies nothing; leave region out");
  MethodResult result;
  try {
    result = long_call(progress, [&](const Progress& report) {
      return visibility(*casters, shape, receivers,
                        {.method = choice.method, .options = choice.options, .progress = report});
    });
  } catch (const UsageError&) {  // it tells a receiver by its number: say it as NumPy does
    require_finite(at, "points");
    require_finite(up, "normals");
    throw;
  }
  py::object seen = owned<float>(std::move(result.visibility), at.shape);
  if (!region && !stats) return seen;
  py::list out;
  out.append(seen);
  if (region) out.append(owned<std::int8_t>(std::move(result.region), at.shape));
  if (stats) out.append(stats_of(choice.method, choice.options, result));
  return py::tuple(out);
}

constexpr const char* kHelp = R"(The fraction of a light that each point sees.

points: (..., 3) real, scene units; C-ordered float64 is not copied, and must not be changed meanwhile.
light: a DiskLight, DistantLight or RectangleLight, or the number or name of one of scene.lights.
normals: as points, unit vectors: what lies below a point's tangent plane is hidden from it. Without normals nothing is.
method: 'silhouette' (exact areas, the usual), 'auto', 'reference' and 'rays' (samples=256, seed=0), 'hard', 'none'.
max_error: RMSE over the penumbra that may be made; the method is then 'auto', which takes the cheapest one that keeps it.
region: also certificates. stats: also a dict of milliseconds, counts and decisions.
objects, faces: integers, one a point or one for all: the object, and the row of its F, on which a point lies. That triangle
hides nothing from it. Give them for points on the casters' own surfaces.
progress: called with the finished fraction now and then; where it returns False the call raises Cancelled.
Further keywords are the method's options, with underscores.

Returns float32 of shape (...): 0 in umbra and behind the light's plane, 1 where all is seen. With region or stats a tuple: the
same, then int8 of the same shape (0 proved to be lit, 1 in part, 2 proved to be in umbra, -1 not certified), then the dict.

Runs on all cores without Python's lock; calls for one scene wait for each other. Ctrl-C stops it. Raises ValueError, TypeError,
Cancelled.)";

}  // namespace

void bind_visibility(SceneClass& scene) {
  scene.def("visibility", &visibility_of, py::arg("points"), py::arg("light"),
            py::arg("normals") = py::none(), py::arg("method") = py::none(), py::kw_only(),
            py::arg("max_error") = py::none(), py::arg("region") = false, py::arg("stats") = false,
            py::arg("objects") = py::none(), py::arg("faces") = py::none(), py::arg("progress") = py::none(),
            kHelp);
}

}  // namespace penumbra::python
