// The last render step, the same for every method: visibility → RGB.
//
// RGB = albedo/π · radiance · F · V/V_h for a diffuse receiver, with F the integral of cos θ cos θ' / d² over
// the part of the light above the receiver's tangent plane (π times the form factor), V_h that part's area
// fraction and V the visibility. Radiance leaves the light's front side only.
#pragma once

#include <cstdint>
#include <span>

#include "penumbra/render/scene/scene.h"
#include "render/image/image.h"
#include "render/light/area_light.h"
#include "render/receivers/surface_buffer.h"

namespace penumbra {

/// F at x with unit normal n: steradians weighted by the receiver's cosine. Lambert's boundary integral of
/// the clipped disk, in closed form (arc and chord). 0 behind the light or wholly below the horizon. At
/// radius 0 the point light's cos θ cos θ' / d², so that `radiance` is read as an intensity.
double disk_irradiance_factor(const DiskLight& light, const Vec3& x, const Vec3& n);

/// V_h: the disk's area fraction above the tangent plane of x, 0 behind the light's plane. At radius 0: 1
/// where the center is above it, else 0.
double fraction_above_horizon(const DiskLight& light, const Vec3& x, const Vec3& n);

/// F and V_h of a disk or a rectangle, whose clipped polygon has Lambert's closed form too.
double irradiance_factor(const AreaLight& light, const Vec3& x, const Vec3& n);
double fraction_above_horizon(const AreaLight& light, const Vec3& x, const Vec3& n);

/// Every channel of the EXR interface: R G B A, visibility, region, object, P, N. Without `region` it is -1
/// (not certified) everywhere but behind the light's plane, where it is 2.
Image shade(const Scene& scene, const SurfaceBuffer& surface, std::span<const float> visibility,
            int threads = 0, std::span<const std::int8_t> region = {});

}  // namespace penumbra
