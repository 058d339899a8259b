// In the light's frame, x = (X, Y, Z) and the disk of radius ρ in z = 0, Lambert's integral over the part of
// the rim from φ0 to φ1 is -1/2 ∫ n·(r × r') / |r|² dφ with r the rim point seen from x. With ψ the angle
// from the direction of (X, Y) the integrand is (A + B cos ψ + D sin ψ) / (E - K cos ψ): an elementary
// integral (`rim_part`).
//
// A distant light is seen on the axis, where the integral becomes short, and where what is of first order in
// a small radius can be taken out of it by hand (`distant_factor`).
#include "render/light/light_integrals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/light/disk_area.h"
#include "render/light/rectangle_area.h"
#include "render/light/whole_disk.h"

namespace penumbra {
namespace {

/// The rim's share between two angles, from < to.
double rim_part(const Vec3& x, const Vec3& n, double rho, double from, double to) {
  const double away = std::hypot(x.x, x.y);
  const double cx = away > 0.0 ? x.x / away : 1.0, cy = away > 0.0 ? x.y / away : 0.0;
  const double radial = n.x * cx + n.y * cy, tangential = n.y * cx - n.x * cy;
  const double a = n.z * rho, b = x.z * radial - n.z * away, d = x.z * tangential;
  const double e = away * away + x.z * x.z + rho * rho, k = 2.0 * rho * away;
  // e - k and e + k, without their cancellation where x is near the rim.
  const double nearer = (away - rho) * (away - rho) + x.z * x.z,
               farther = (away + rho) * (away + rho) + x.z * x.z;
  const double s = std::sqrt(nearer * farther), q = k / (e + s);
  const double turn = std::atan2(cy, cx), psi0 = from - turn, psi1 = to - turn;
  const bool on_axis = k < 1e-12 * e;
  const auto bend = [&](double psi) { return std::atan2(q * std::sin(psi), 1.0 - q * std::cos(psi)); };
  const double bends = bend(psi1) - bend(psi0);
  const double bends_by_k = on_axis ? (std::sin(psi1) - std::sin(psi0)) / (e + s) : bends / k;
  const double lower = e - k * std::cos(psi0), rise = std::cos(psi0) - std::cos(psi1);
  const double logarithm = on_axis ? rise / lower : std::log1p(k * rise / lower) / k;
  const double span = psi1 - psi0;
  const double integral =
      a * (span + 2.0 * bends) / s + b * (q * span + 2.0 * e * bends_by_k) / s + d * logarithm;
  return -0.5 * rho * integral;
}

double factor_in_frame(const Vec3& x, const Vec3& n, double rho) {
  if (x.z <= 0.0) return 0.0;
  if (rho == 0.0) {
    const double d2 = glm::dot(x, x);
    return std::max(0.0, -glm::dot(n, x)) * x.z / (d2 * d2);
  }
  const Chord horizon = chord_of_plane(n, x, rho);
  if (!(horizon.delta > -1.0)) return 0.0;
  if (horizon.delta >= 1.0) return std::max(0.0, detail::whole_rim(x.x, x.y, x.z, n.x, n.y, n.z, rho));
  const double middle = std::atan2(horizon.normal.y, horizon.normal.x), reach = std::acos(-horizon.delta);
  const auto rim = [&](double angle) { return Vec3{rho * std::cos(angle), rho * std::sin(angle), 0.0} - x; };
  return std::max(0.0, rim_part(x, n, rho, middle - reach, middle + reach) +
                           detail::edge_irradiance(rim(middle + reach), rim(middle - reach), n));
}

/// atan t - t/(1 + t²), t ≥ 0: by its series where the two are nearly equal.
double arc_less_chord(double t) {
  if (t > 0.05) return std::atan(t) - t / (1.0 + t * t);
  const double q = t * t;
  return t * q *
         (2.0 / 3 - q * (4.0 / 5 - q * (6.0 / 7 - q * (8.0 / 9 - q * (10.0 / 11 - q * (12.0 / 13))))));
}

/// With δ the horizon's chord, c² = 1 + ρ²δ² and t = ρ√(1-δ²)/c: the arc gives (ρ³δ acos(-δ)/c - t)/(1 + ρ²),
/// the chord atan t, where 1 + ρ² = c²(1 + t²). Both are of the order of ρ and their sum of ρ³, hence the
/// other order.
double distant_factor(const Vec3& n, double rho) {
  if (rho == 0.0) return std::max(0.0, -n.z);
  const double delta = chord_of_plane(n, {0.0, 0.0, 1.0}, rho).delta, all = 1.0 + rho * rho;
  if (!(delta > -1.0)) return 0.0;
  if (delta >= 1.0) return detail::whole_distant(n.z, rho);
  const double c2 = 1.0 + rho * rho * delta * delta, c = std::sqrt(c2);
  const double t = rho * std::sqrt((1.0 - delta) * (1.0 + delta)) / c;
  const double arc = delta * (rho * rho * rho * std::acos(-delta) / c + t * rho * rho * delta) / all;
  return std::max(0.0, arc + arc_less_chord(t));
}

double horizon_in_frame(const Vec3& x, const Vec3& n, double rho) {
  if (x.z <= 0.0) return 0.0;
  if (rho == 0.0) return glm::dot(n, x) < 0.0 ? 1.0 : 0.0;
  return half_plane_area(chord_of_plane(n, x, rho).delta);
}

}  // namespace

double disk_irradiance_factor(const DiskLight& light, const Vec3& x, const Vec3& n) {
  return irradiance_factor(area_light(light), x, n);
}

double fraction_above_horizon(const DiskLight& light, const Vec3& x, const Vec3& n) {
  return fraction_above_horizon(area_light(light), x, n);
}

double irradiance_factor(const AreaLight& light, const Vec3& x, const Vec3& n) {
  return irradiance_factor(light, to_light_frame(light, x, n));
}

double fraction_above_horizon(const AreaLight& light, const Vec3& x, const Vec3& n) {
  return fraction_above_horizon(light, to_light_frame(light, x, n));
}

double irradiance_factor(const AreaLight& light, const InLightFrame& p) {
  if (light.distant) return distant_factor(p.n, light.half.x);
  return light.disk ? factor_in_frame(p.x, p.n, light.half.x)
                    : detail::rectangle_irradiance_factor(p.x, p.n, light.half);
}

double fraction_above_horizon(const AreaLight& light, const InLightFrame& p) {
  return light.disk ? horizon_in_frame(p.x, p.n, light.half.x)
                    : detail::rectangle_above_horizon(p.x, p.n, light.half);
}

}  // namespace penumbra
