// Irradiance factors of disks that no horizon cuts, in the light's frame.
#pragma once

#include <cmath>
#include <numbers>

#include "render/support/vector_clones.h"

namespace penumbra::detail {

/// Lambert's integral over the whole rim of the disk of radius rho around the origin: what a part of the rim
/// comes to (light_integrals.cpp) over a full turn, without its angles.
PENUMBRA_INLINE double whole_rim(double x, double y, double z, double nx, double ny, double nz, double rho) {
  const double away2 = x * x + y * y, away = std::sqrt(away2);
  const double e = away2 + z * z + rho * rho, k = 2.0 * rho * away;
  const double nearer = (away - rho) * (away - rho) + z * z, farther = (away + rho) * (away + rho) + z * z;
  const double s = std::sqrt(nearer * farther), q = k / (e + s);
  const double across = (nx * x + ny * y) / (away > 0.0 ? away : 1.0);
  const double radial = away > 0.0 ? across : nx;
  return -std::numbers::pi * rho * (nz * rho + q * (z * radial - nz * away)) / s;
}

/// The same of a distant light, whose disk of radius rho lies at unit distance.
PENUMBRA_INLINE double whole_distant(double nz, double rho) {
  return -nz * (std::numbers::pi * rho * rho / (1.0 + rho * rho));
}

}  // namespace penumbra::detail
