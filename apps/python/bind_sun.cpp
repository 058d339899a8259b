// The sun: its position, the light that it is, and what points see of it from time to time (render/sun/).
#include "apps/python/bindings.h"
#include "apps/python/long_call.h"
#include "apps/python/python_lights.h"
#include "apps/python/python_surfaces.h"
#include "penumbra/render/sun/sun_exposure.h"

namespace penumbra::python {
namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Seconds since 1970: datetime64, which counts as UTC, or numbers.
Doubles seconds_of(const py::object& times) {
  py::array array = py::array::ensure(times);
  if (!array) throw py::type_error("times are no array; give datetime64 (UTC) or seconds since 1970");
  if (array.dtype().kind() == 'M') {
    const py::object micro = array.attr("astype")("datetime64[us]");
    if (py::module_::import("numpy").attr("isnat")(micro).attr("any")().cast<bool>())
      throw py::value_error("times have a NaT; give times alone");
    return Doubles(micro.attr("astype")("int64").attr("__truediv__")(1e6));
  }
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw py::type_error("times have the type " + std::string(py::str(array.dtype())) +
                         "; give datetime64 (UTC) or seconds since 1970");
  return Doubles(array);
}

SunSite site_of(double latitude, double longitude, double pressure, double temperature) {
  return {.latitude = latitude, .longitude = longitude, .pressure = pressure, .temperature = temperature};
}

py::tuple position_of(const py::object& times, double latitude, double longitude, double pressure,
                      double temperature) {
  const Doubles seconds = seconds_of(times);
  const SunSite site = site_of(latitude, longitude, pressure, temperature);
  std::vector<double> azimuths, elevations, radii;
  for (py::ssize_t i = 0; i < seconds.size(); ++i) {
    const SunPosition sun = sun_position(seconds.data()[i], site);
    azimuths.push_back(sun.azimuth);
    elevations.push_back(sun.elevation);
    radii.push_back(sun.radius);
  }
  const Shape shape = shape_of(seconds);
  return py::make_tuple(owned<double>(std::move(azimuths), shape),
                        owned<double>(std::move(elevations), shape), owned<double>(std::move(radii), shape));
}

py::object light_at(const py::object& time, double latitude, double longitude, const py::object& up,
                    const py::object& north, double pressure, double temperature) {
  const Doubles seconds = seconds_of(time);
  if (seconds.size() != 1)
    throw py::value_error("time has shape " + text_of(shape_of(seconds)) + "; give one");
  const SunPosition sun =
      sun_position(seconds.data()[0], site_of(latitude, longitude, pressure, temperature));
  return python_light({.shape = sun_light(sun, {vector_of(up, "up"), vector_of(north, "north")})});
}

struct SunResult {
  std::vector<float> seen;
  std::vector<SunContact> contacts;
};

/// Over all times; `contacts`: between each and the next, too.
SunResult look(SunExposure& sun, std::span<const double> times, bool contacts, const Progress& progress) {
  SunResult out;
  std::vector<float> before;
  for (std::size_t k = 0; k < times.size(); ++k) {
    report(progress, static_cast<double>(k) / static_cast<double>(times.size()));
    std::vector<float> now = sun.seen(times[k]);
    if (contacts && k > 0) {
      const auto more = sun.contacts(times[k - 1], before, times[k], now);
      out.contacts.insert(out.contacts.end(), more.begin(), more.end());
    }
    out.seen.insert(out.seen.end(), now.begin(), now.end());
    before = std::move(now);
  }
  return out;
}

py::dict arrays_of(const std::vector<SunContact>& contacts) {
  std::vector<std::uint32_t> receivers;
  std::vector<double> times;
  std::vector<std::int8_t> events;
  for (const SunContact& contact : contacts) {
    receivers.push_back(contact.receiver);
    times.push_back(contact.time);
    events.push_back(static_cast<std::int8_t>(contact.kind));
  }
  const Shape shape = {static_cast<py::ssize_t>(contacts.size())};
  py::dict out;
  out["receiver"] = owned<std::uint32_t>(std::move(receivers), shape);
  out["time"] = owned<double>(std::move(times), shape);
  out["event"] = owned<std::int8_t>(std::move(events), shape);
  return out;
}

py::object sun_of(PythonScene& scene, const py::object& points, const py::object& times, double latitude,
                  double longitude, const py::object& normals, const py::object& up, const py::object& north,
                  double pressure, double temperature, const py::object& objects, const py::object& faces,
                  bool contacts, const py::object& progress) {
  const PointArray at = points_of(points, "points");
  require_finite(at, "points");
  PointArray normal;
  if (!normals.is_none()) normal = normals_of(normals, at);
  const Surfaces on = surfaces_of(scene.scene(), objects, faces, at.shape);
  const Doubles seconds = seconds_of(times);
  if (seconds.ndim() != 1)
    throw py::value_error("times have shape " + text_of(shape_of(seconds)) + "; give a row of times");
  const std::span<const double> row(seconds.data(), static_cast<std::size_t>(seconds.size()));
  for (std::size_t k = 1; contacts && k < row.size(); ++k)
    if (!(row[k] > row[k - 1]))
      throw py::value_error(place_of("times", {seconds.size()}, k) +
                            " is not after the one before; sort them");
  const SunSky sky{site_of(latitude, longitude, pressure, temperature),
                   {vector_of(up, "up"), vector_of(north, "north")}};
  const auto casters = scene.casters();
  const Receivers receivers{
      .points = at.points, .normals = normal.points, .objects = on.objects, .faces = on.faces};
  SunResult result = long_call(progress, [&](const Progress& report) {
    SunExposure sun(*casters, receivers, sky);
    return look(sun, row, contacts, report);
  });
  Shape shape = at.shape;
  shape.insert(shape.begin(), seconds.size());
  py::object seen = owned<float>(std::move(result.seen), std::move(shape));
  if (!contacts) return seen;
  return py::make_tuple(seen, arrays_of(result.contacts));
}

constexpr const char* kPositionHelp =
    R"(Where the sun stands: azimuth, elevation and radius, degrees, in the shape of times.

times: datetime64, which counts as UTC, or seconds since 1970. latitude, longitude: degrees, north and east positive.
pressure: of the air, millibar; 0 is no refraction. temperature: degrees Celsius. Azimuths run from north over east; elevations
are those that are seen; the radius is half the angle that the disk fills. Within 6" of the IAU's routines from 1900 to 2100.)";

constexpr const char* kLightHelp = R"(The sun at one time as a DistantLight.

up, north: the scene's axes, 3 numbers each. Others as of sun_position.)";

constexpr const char* kSunHelp =
    R"(The fraction of the sun's disk that each point sees at each time: float32 of shape (len(times), ...).

points, normals, objects, faces, progress: as of visibility. times, latitude, longitude, pressure, temperature: as of
sun_position; up, north: as of sun_light. The sun is dark as far as it stands below the horizontal plane.
contacts: also a dict of arrays, when the sun begins and ceases to be seen, to .25 s: 'receiver' (number of the point in C
order), 'time' (seconds since 1970), 'event' (0 first light, 1 full light, 2 first shade, 3 last light). Found are changes between one
time and the next; times must ascend.)";

}  // namespace

void bind_sun(py::module_& module, SceneClass& scene) {
  module.def("sun_position", position_of, py::arg("times"), py::arg("latitude"), py::arg("longitude"),
             py::kw_only(), py::arg("pressure") = 1010.0, py::arg("temperature") = 10.0, kPositionHelp);
  const py::tuple y = py::make_tuple(0.0, 1.0, 0.0), z = py::make_tuple(0.0, 0.0, -1.0);
  module.def("sun_light", light_at, py::arg("time"), py::arg("latitude"), py::arg("longitude"), py::kw_only(),
             py::arg("up") = y, py::arg("north") = z, py::arg("pressure") = 1010.0,
             py::arg("temperature") = 10.0, kLightHelp);
  scene.def("sun", sun_of, py::arg("points"), py::arg("times"), py::arg("latitude"), py::arg("longitude"),
            py::arg("normals") = py::none(), py::kw_only(), py::arg("up") = y, py::arg("north") = z,
            py::arg("pressure") = 1010.0, py::arg("temperature") = 10.0, py::arg("objects") = py::none(),
            py::arg("faces") = py::none(), py::arg("contacts") = false, py::arg("progress") = py::none(),
            kSunHelp);
}

}  // namespace penumbra::python
