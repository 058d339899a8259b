// Where the sun stands: its direction and size at a time and a place on earth, as a distant light of the
// scene.
//
// In: seconds since 1970 UTC, latitude and longitude. Out: azimuth, elevation, radius; the DistantLight.
//
// J. Meeus, "Astronomical Formulae for Calculators" (1982), chapter 18: the sun's longitude after Newcomb
// with the corrections for planets and moon. "Astronomical Algorithms" (1991): nutation and obliquity
// (chapter 21), sidereal time (11), parallax (39), refraction after Sæmundsson (15.4). Ten more terms of
// planets are ours: their amplitudes are fitted to the positions of the library ERFA. From 1900 to 2100 the
// longitude is then off by 1.4" RMS and 5.5" at most (14" without these terms); the sun moves by 15" a
// second. UT1 is taken to be UTC, from which it differs by less than a second.
#pragma once

#include "penumbra/mesh/types.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra {

/// A place, and what bends light there.
struct SunSite {
  /// Degrees, north and east positive: -90 to 90, and -180 to 360.
  double latitude = 0.0, longitude = 0.0;
  /// Of the air, millibar: refraction raises a low sun by half a degree. 0: none.
  double pressure = 1010.0;
  /// Of the air, degrees Celsius, above -273.
  double temperature = 10.0;
  /// Terrestrial time minus UTC, seconds. An error of a minute moves the sun by 2.5".
  double delta_t = 69.2;
};

/// All angles in degrees.
struct SunPosition {
  /// From north over east, 0 to 360.
  double azimuth = 0.0;
  /// Above the horizontal plane, as it is seen: with parallax and refraction.
  double elevation = 0.0;
  /// Half the angle that the disk fills.
  double radius = 0.0;
  /// Astronomical units.
  double distance = 1.0;
};

/// Throws UsageError where the time is not finite, or the site's numbers are outside of their domain. Cost
/// O(1).
SunPosition sun_position(double unix_time, const SunSite& site);

/// How a scene lies on earth. East is north × up.
struct SceneAxes {
  /// Of any length but 0.
  Vec3 up{0.0, 1.0, 0.0};
  /// Of any length; only its part across `up` counts, which must not be 0.
  Vec3 north{0.0, 0.0, -1.0};
};

/// The sun as a light. Throws UsageError where the axes are 0, parallel or not finite.
DistantLight sun_light(const SunPosition& sun, const SceneAxes& axes);

}  // namespace penumbra
