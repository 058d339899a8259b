#include "penumbra/render/sun/sun_position.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSecond = 1.0 / 3600.0;  // of arc, in degrees
constexpr double kDay = 86400.0;
constexpr double kUnixEpoch = 2440587.5;  // as a Julian day
constexpr double kCentury = 36525.0;      // days
constexpr double kJ1900 = 2415020.0, kJ2000 = 2451545.0;
constexpr double kAberration = 20.4898 * kSecond, kParallax = 8.794 * kSecond;
constexpr double kRadius = 959.63 * kSecond;  // of the sun at one astronomical unit

double sine(double degrees) {
  return std::sin(degrees * kDegree);
}
double cosine(double degrees) {
  return std::cos(degrees * kDegree);
}
double turned(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0.0 ? rest + 360.0 : rest;
}

/// amplitude · cos(earth, venus, jupiter and mars times their mean anomalies or longitudes - phase).
struct PlanetTerm {
  int earth, venus, jupiter, mars;
  double seconds, phase;
};
constexpr PlanetTerm kPlanetTerms[] = {
    {0, 0, 1, 0, 2.62, 264.2},  {-2, 0, 2, 0, 2.73, 87.6},  {-3, 2, 0, 0, 2.47, 45.1},
    {-2, 0, 0, 2, 2.06, 344.3}, {-1, 0, 0, 2, 1.72, 199.4}, {-1, 0, 2, 0, 1.62, 109.4},
    {-4, 3, 0, 0, 1.45, 22.8},  {-5, 3, 0, 0, 0.89, 34.6},  {-3, 3, 0, 0, 0.66, 183.7},
    {-2, 0, 3, 0, 0.54, 83.4},
};

double planets(double day) {
  const double t = (day - kJ2000) / kCentury;
  const double earth = 357.529 + 35999.050 * t, venus = 50.416 + 58517.803 * t,
               jupiter = 20.020 + 3034.906 * t, mars = 19.373 + 19139.858 * t;
  double sum = 0.0;
  for (const PlanetTerm& term : kPlanetTerms)
    sum += term.seconds * cosine(term.earth * earth + term.venus * venus + term.jupiter * jupiter +
                                 term.mars * mars - term.phase);
  return sum * kSecond;
}

struct Ecliptic {
  double longitude;  ///< degrees, of the mean equinox of the date, geometric
  double distance;   ///< astronomical units
};

Ecliptic newcomb(double day) {
  const double t = (day - kJ1900) / kCentury;
  const double mean = 279.69668 + t * (36000.76892 + t * 0.0003025);
  const double anomaly = 358.47583 + t * (35999.04975 - t * (0.000150 + t * 0.0000033));
  const double e = 0.01675104 - t * (0.0000418 + t * 0.000000126);
  const double center = (1.919460 - t * (0.004789 + t * 0.000014)) * sine(anomaly) +
                        (0.020094 - 0.000100 * t) * sine(2.0 * anomaly) + 0.000293 * sine(3.0 * anomaly);
  const double a = 153.23 + 22518.7541 * t, b = 216.57 + 45037.5082 * t, c = 312.69 + 32964.3577 * t,
               d = 350.74 + t * (445267.1142 - 0.00144 * t), h = 353.40 + 65928.7155 * t;
  const double longitude = mean + center + 0.00134 * cosine(a) + 0.00154 * cosine(b) + 0.00200 * cosine(c) +
                           0.00179 * sine(d) + 0.00178 * sine(231.19 + 20.20 * t);
  const double distance = 1.0000002 * (1.0 - e * e) / (1.0 + e * cosine(anomaly + center)) +
                          0.00000543 * sine(a) + 0.00001575 * sine(b) + 0.00001627 * sine(c) +
                          0.00003076 * cosine(d) + 0.00000927 * sine(h);
  return {longitude + planets(day), distance};
}

struct Nutation {
  double longitude, obliquity;  ///< degrees
};

Nutation nutation(double t) {
  const double node = 125.04452 - 1934.136261 * t, sun = 2.0 * (280.4665 + 36000.7698 * t),
               moon = 2.0 * (218.3165 + 481267.8813 * t);
  return {
      (-17.20 * sine(node) - 1.32 * sine(sun) - 0.23 * sine(moon) + 0.21 * sine(2.0 * node)) * kSecond,
      (9.20 * cosine(node) + 0.57 * cosine(sun) + 0.10 * cosine(moon) - 0.09 * cosine(2.0 * node)) * kSecond};
}

/// Degrees by which air raises what stands at this elevation. Below -1 the same as there: nothing is seen so
/// low, and it stays continuous.
double refraction(double elevation, const SunSite& site) {
  const double h = std::max(elevation, -1.0);
  return site.pressure / 1010.0 * 283.0 / (273.0 + site.temperature) * 1.02 / 60.0 /
         std::tan((h + 10.3 / (h + 5.11)) * kDegree);
}

void require_valid(double unix_time, const SunSite& site) {
  if (!std::isfinite(unix_time)) throw UsageError("the time is not finite; give seconds since 1970");
  const auto require = [](double value, double least, double most, const char* what) {
    if (!(value >= least && value <= most))
      throw UsageError(std::string(what) + " is " + std::to_string(value) + "; give " +
                       std::to_string(static_cast<int>(least)) + " to " +
                       std::to_string(static_cast<int>(most)));
  };
  require(site.latitude, -90.0, 90.0, "the latitude");
  require(site.longitude, -180.0, 360.0, "the longitude");
  require(site.pressure, 0.0, 5000.0, "the pressure");
  require(site.temperature, -272.0, 1000.0, "the temperature");
  require(site.delta_t, -1e6, 1e6, "terrestrial time minus UTC");
}

}  // namespace

SunPosition sun_position(double unix_time, const SunSite& site) {
  require_valid(unix_time, site);
  const double day = kUnixEpoch + unix_time / kDay, ephemeris_day = day + site.delta_t / kDay;
  const double t = (ephemeris_day - kJ2000) / kCentury;
  const Ecliptic sun = newcomb(ephemeris_day);
  const Nutation nutated = nutation(t);
  const double longitude = sun.longitude + nutated.longitude - kAberration / sun.distance;
  const double obliquity = 23.0 + 26.0 / 60.0 + 21.448 * kSecond -
                           t * (46.8150 + t * (0.00059 - t * 0.001813)) * kSecond + nutated.obliquity;
  // Right ascension and declination, then the hour angle. Whole days are taken out before they are
  // multiplied.
  const double ascension = std::atan2(cosine(obliquity) * sine(longitude), cosine(longitude)) / kDegree;
  const double sin_declination = sine(obliquity) * sine(longitude),
               cos_declination = std::sqrt(1.0 - sin_declination * sin_declination);
  const double since_2000 = (kUnixEpoch - kJ2000) + unix_time / kDay, c = since_2000 / kCentury;
  const double sidereal = 280.46061837 + 360.0 * (since_2000 - std::floor(since_2000)) +
                          0.98564736629 * since_2000 + c * c * (0.000387933 - c / 38710000.0) +
                          nutated.longitude * cosine(obliquity);
  const double hour = turned(sidereal + site.longitude - ascension);
  const double east = -cos_declination * sine(hour);
  const double north =
      cosine(site.latitude) * sin_declination - sine(site.latitude) * cos_declination * cosine(hour);
  const double up =
      sine(site.latitude) * sin_declination + cosine(site.latitude) * cos_declination * cosine(hour);
  double elevation = std::atan2(up, std::hypot(east, north)) / kDegree;
  elevation -= kParallax / sun.distance * cosine(elevation);
  if (site.pressure > 0.0) elevation += refraction(elevation, site);
  return {turned(std::atan2(east, north) / kDegree), elevation, kRadius / sun.distance, sun.distance};
}

DistantLight sun_light(const SunPosition& sun, const SceneAxes& axes) {
  const Vec3 up = glm::normalize(axes.up), across = axes.north - glm::dot(axes.north, up) * up;
  const double length = glm::length(across);
  if (!(length > 1e-9 * glm::length(axes.north)))  // NaN, too
    throw UsageError("up and north are 0, parallel or not finite; give two axes that differ");
  const Vec3 north = across / length, east = glm::cross(north, up);
  const Vec3 towards = cosine(sun.elevation) * (sine(sun.azimuth) * east + cosine(sun.azimuth) * north) +
                       sine(sun.elevation) * up;
  return {-towards, 2.0 * sun.radius};
}

}  // namespace penumbra
