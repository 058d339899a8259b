// umbra, penumbra, level: solids (render/solids/extrude_solid.h).
#include <cmath>

#include "apps/python/bindings.h"
#include "apps/python/long_call.h"
#include "apps/python/python_lights.h"
#include "apps/python/python_options.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/solids/extrude_solid.h"

namespace penumbra::python {
namespace {

Bounds bound_of(const py::object& bound) {
  if (bound.is_none()) return {};
  const PointArray corners = rows_of(bound, "bound");
  if (corners.points.size() != 2)
    throw py::value_error("bound has shape " + text_of(shape_of(corners.array)) +
                          "; give (2, 3): the lowest and the highest corner");
  require_finite(corners, "bound");
  const Bounds out{corners.points[0], corners.points[1]};
  for (int k = 0; k < 3; ++k)
    if (!(out.low[k] < out.high[k]))
      throw py::value_error(
          "bound's first row is not below its second; give the lowest and the highest corner");
  return out;
}

py::dict report_of(ShadowSolid& solid) {
  py::dict out;
  out["guarantee"] = name_of(solid.mesh.guarantee);
  out["volume"] = solid.volume;
  out["area"] = solid.area;
  out["tolerance"] = solid.tolerance;
  out["spacing"] = solid.spacing;
  out["proved"] = solid.proved;
  out["to_prove"] = solid.to_prove;
  out["evaluations"] = solid.evaluations;
  out["grid_points"] = solid.grid_points;
  const auto triangles = static_cast<py::ssize_t>(solid.is_proved.size());
  out["is_proved"] = owned<bool>(std::move(solid.is_proved), {triangles});
  std::vector<char> far_caps;
  for (const ShadowTag& tag : solid.mesh.tags) far_caps.push_back(tag.kind == ShadowKind::kFarCap);
  out["is_far_cap"] = owned<bool>(std::move(far_caps), {triangles});
  out["milliseconds"] = dict_of(solid.stages);
  return out;
}

py::tuple solid_of(PythonScene& scene, const py::object& light, const ShadowLevel& level,
                   const py::object& tolerance, const py::object& bound, bool hollow, bool report,
                   const py::object& progress) {
  const LightShape shape = light_of(scene.scene(), light);
  SolidOptions options{.bound = bound_of(bound), .hollow = hollow};
  if (!tolerance.is_none()) {
    options.tolerance = tolerance.cast<double>();
    if (!(options.tolerance > 0.0) || std::isinf(options.tolerance))
      throw py::value_error(
          "tolerance is no length above 0; give scene units, or leave it out for a hundredth of "
          "the casters' diagonal");
  }
  const auto casters = scene.casters();
  ShadowSolid solid = long_call(progress, [&](const Progress& watched) {
    options.progress = watched;
    return extrude_solid(*casters, shape, level, options);
  });
  const py::array vertices = owned_rows(std::move(solid.mesh.positions));
  const py::array triangles = owned_rows(std::move(solid.mesh.triangles));
  if (!report) return py::make_tuple(vertices, triangles);
  return py::make_tuple(vertices, triangles, report_of(solid));
}

const std::string kRest = R"(

tolerance: scene units; detail of this size is kept. None: a hundredth of the diagonal of the casters' box.
bound: (2, 3), lowest and highest corner, where the solid ends; it holds the casters. None: their box, grown by its diagonal.
hollow: without the bodies of the casters. report: also a dict. progress: as of Scene.visibility.

Returns V (n, 3) float64, scene units, and F (m, 3) uint32: closed, oriented outward, without self-intersections; both empty where
there is none. With report also a dict: guarantee ('certified' where every triangle is proved, else 'within'), volume, area,
proved, to_prove, is_proved (m,) bool, is_far_cap (m,) bool, tolerance, spacing, grid_points, evaluations, milliseconds. Takes
seconds, on all cores, without Python's lock; Ctrl-C stops it.)";

template <class Function, class... More>
void define(py::module_& module, const char* name, const std::string& first, Function&& function,
            const More&... more) {
  module.def(name, std::forward<Function>(function), py::arg("scene"), py::arg("light"), more...,
             py::kw_only(), py::arg("tolerance") = py::none(), py::arg("bound") = py::none(),
             py::arg("hollow") = false, py::arg("report") = false, py::arg("progress") = py::none(),
             (first + kRest).c_str());
}

}  // namespace

void bind_solids(py::module_& module) {
  using O = const py::object&;
  define(module, "umbra", "The solid of points that see none of the light.",
         [](PythonScene& scene, O light, O tolerance, O bound, bool hollow, bool report, O progress) {
           return solid_of(scene, light, {ShadowLevel::Kind::kUmbra}, tolerance, bound, hollow, report,
                           progress);
         });
  define(module, "penumbra",
         "The solid of points that do not see all of the light: umbra and penumbra together.",
         [](PythonScene& scene, O light, O tolerance, O bound, bool hollow, bool report, O progress) {
           return solid_of(scene, light, {ShadowLevel::Kind::kPenumbra}, tolerance, bound, hollow, report,
                           progress);
         });
  define(
      module, "level",
      "The solid of points that see at most the given fraction of the light, above 0 and below 1.",
      [](PythonScene& scene, O light, double fraction, O tolerance, O bound, bool hollow, bool report,
         O progress) {
        return solid_of(scene, light, {ShadowLevel::Kind::kFraction, fraction}, tolerance, bound, hollow,
                        report, progress);
      },
      py::arg("fraction"));
}

}  // namespace penumbra::python
