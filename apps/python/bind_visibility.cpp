// Scene.visibility: the one call for visibility (render/visibility.h), on arrays.
#include "apps/python/bindings.h"
#include "apps/python/long_call.h"
#include "apps/python/python_lights.h"
#include "apps/python/python_options.h"
#include "apps/python/python_surfaces.h"
#include "penumbra/mesh/error.h"

namespace penumbra::python {
namespace {

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

std::vector<LightShape> lights_of(const Scene& scene, const py::object& light, bool several) {
  if (!several) return {light_of(scene, light)};
  std::vector<LightShape> lights;
  for (const py::handle& each : light)
    lights.push_back(light_of(scene, py::reinterpret_borrow<py::object>(each)));
  return lights;
}

/// The arrays of all results, one after the other. That of a lone result is not copied.
template <class T>
std::vector<T> joined(std::vector<MethodResult>& results, std::vector<T> MethodResult::*part) {
  if (results.size() == 1) return std::move(results[0].*part);
  std::vector<T> all;
  for (MethodResult& result : results) {
    all.insert(all.end(), (result.*part).begin(), (result.*part).end());
    result.*part = {};
  }
  return all;
}

py::object visibility_of(PythonScene& scene, const py::object& points, const py::object& light,
                         const py::object& normals, const py::object& method, const py::object& max_error,
                         bool region, bool stats, const py::object& objects, const py::object& faces,
                         const py::object& progress, const py::kwargs& options) {
  const PointArray at = points_of(points, "points");
  PointArray up;
  if (!normals.is_none()) up = normals_of(normals, at);
  const Surfaces on = surfaces_of(scene.scene(), objects, faces, at.shape);
  const MethodChoice choice = choice_of(method, max_error, options);
  const bool several = py::isinstance<py::list>(light);
  const std::vector<LightShape> lights = lights_of(scene.scene(), light, several);
  const auto casters = scene.casters();
  const Receivers receivers{
      .points = at.points, .normals = up.points, .objects = on.objects, .faces = on.faces};
  if (region && !method_named(choice.method).certifies)
    throw py::value_error("method '" + choice.method + "' certifies nothing; leave region out");
  std::vector<MethodResult> results;
  try {
    results = long_call(progress, [&](const Progress& report) {
      return visibility(*casters, std::span(lights), receivers,
                        {.method = choice.method, .options = choice.options, .progress = report});
    });
  } catch (const UsageError&) {  // it tells a receiver by its number: say it as NumPy does
    require_finite(at, "points");
    require_finite(up, "normals");
    throw;
  }
  Shape shape = at.shape;
  if (several) shape.insert(shape.begin(), static_cast<py::ssize_t>(lights.size()));
  py::object seen = owned<float>(joined(results, &MethodResult::visibility), shape);
  if (!region && !stats) return seen;
  py::list out, said;
  out.append(seen);
  if (region) out.append(owned<std::int8_t>(joined(results, &MethodResult::region), shape));
  for (const MethodResult& result : results) said.append(stats_of(choice.method, choice.options, result));
  if (stats) out.append(several ? py::object(said) : py::object(said[0]));
  return py::tuple(out);
}

constexpr const char* kHelp = R"(The fraction of a light that each point sees.

points: (..., 3) real, scene units; C-ordered float64 is not copied, and must not be changed meanwhile.
light: a DiskLight, DistantLight or RectangleLight, or the number or name of one of scene.lights; or a list of lights: results then
have one more axis, the first, and stats are a list.
normals: as points, unit vectors: what lies below a point's tangent plane is hidden from it. Without normals nothing is.
method: 'silhouette' (exact areas, the usual), 'auto', 'reference' and 'rays' (samples=256, seed=1), 'hard', 'none', or any
other that needs no pixels.
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
