// Occlusion textures, step 5: how much of the light the slices leave, receiver by receiver.
//
// In: prefiltered slices, receivers. Out: V. "Occlusion textures" (2006), sections 3.1, 3.3 and 3.4. Seen
// from a receiver the light covers one box on a slice's plane. With Δ the distance of receiver and plane over
// the receiver's weight (render/light/light_projection.h), its half extents are spread · Δ, and its middle is
// (u, v) + toward · Δ, toward being the way from the receiver to the light's center for a step of 1 towards
// the light. What of the box is below the receiver's horizon, or above it by less than texels can tell, is
// left out: there lies the surface that the receiver is on. The mean of the slice's texture over that box is
// the part that the slice hides. Slices that end behind the receiver do not count. The one that ends just
// before it fades in with the receiver's distance to its plane, from 0 to 1 over one slice.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "render/occlusion_textures/frustum.h"
#include "render/occlusion_textures/masks.h"
#include "render/occlusion_textures/mip_pyramid.h"
#include "render/occlusion_textures/n_buffer.h"
#include "render/occlusion_textures/summed_area.h"

namespace penumbra::detail {

/// The light's shape as boxes, in units of its half extents, with the area fraction of each.
struct KernelPart {
  double x0, y0, x1, y1, share;
};
/// One box, or for OcclusionKernel::kDisk of a disk light strips across it.
std::vector<KernelPart> kernel_parts(const AreaLight& light, OcclusionKernel kernel);

/// Receivers that are looked up together, in local coordinates.
struct SliceReceivers {
  static constexpr std::size_t kMost = TexelBoxes::kMost;
  std::size_t count = 0;
  alignas(64) std::array<double, kMost> u, v, w;
  /// 1 over the weight; the way to the light's center for a step of 1 towards the light's plane, times the
  /// weight.
  alignas(64) std::array<double, kMost> per_weight, toward_u, toward_v;
  /// The horizon where it crosses a plane w = const: the unit vector up it along the plane, and how far it
  /// climbs along that for a step of 1 towards the light.
  alignas(64) std::array<double, kMost> up_u, up_v, climb;
  /// Fraction of the light above the horizon.
  alignas(64) std::array<double, kMost> above;
  /// Out: V.
  alignas(64) std::array<double, kMost> visibility;
  /// Local coordinates. Precondition: p is in front of the light.
  void add(const Vec3& p, const Vec3& normal, const LightProjection& light, double above_horizon);
};

/// Visibility at points, as a fraction of the light. One class a filter.
class OcclusionLookup {
 public:
  virtual ~OcclusionLookup() = default;
  /// Fills `visibility`. Cost O(slices) a receiver, whatever the light's size.
  virtual void look_up(SliceReceivers& receivers) const = 0;
  virtual std::size_t bytes() const = 0;
};
/// Prefilters all slices, several at a time.
std::unique_ptr<OcclusionLookup> make_occlusion_lookup(const std::vector<SliceTexels>& slices,
                                                       const SliceFrustum& frustum, const SliceSpace& space,
                                                       const OcclusionOptions& options);

}  // namespace penumbra::detail
