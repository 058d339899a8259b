// What a receiver's tangent plane leaves of a light: its area and its irradiance, in closed form.
#pragma once

#include "render/light/area_light.h"

namespace penumbra {

/// F at x with unit normal n: the integral of cos θ cos θ' / d² over the part of the light above the tangent
/// plane, steradians weighted by the receiver's cosine (π times the form factor). Lambert's boundary integral
/// of the clipped disk (arc and chord) or polygon. 0 behind the light or wholly below the horizon. At radius
/// 0 the point light's cos θ cos θ' / d², so that a radiance is read as an intensity; of a distant light of
/// angle 0 cos θ, so that it is read as an irradiance.
double irradiance_factor(const AreaLight& light, const Vec3& x, const Vec3& n);
double disk_irradiance_factor(const DiskLight& light, const Vec3& x, const Vec3& n);

/// V_h: the light's area fraction above the tangent plane of x, 0 behind the light's plane. At radius 0: 1
/// where the center is above it, else 0.
double fraction_above_horizon(const AreaLight& light, const Vec3& x, const Vec3& n);
double fraction_above_horizon(const DiskLight& light, const Vec3& x, const Vec3& n);

/// A receiver in the light's frame, for who asks for both.
struct InLightFrame {
  Vec3 x, n;
};
inline InLightFrame to_light_frame(const AreaLight& light, const Vec3& world, const Vec3& normal) {
  return {light.to_light(world), light.direction_to_light(normal)};
}
double irradiance_factor(const AreaLight& light, const InLightFrame& p);
double fraction_above_horizon(const AreaLight& light, const InLightFrame& p);

}  // namespace penumbra
