// The light: a flat disk that emits on the side of its normal.
#pragma once

#include "penumbra/mesh/types.h"

namespace penumbra {

/// Nothing behind the light's plane casts, and nothing there is lit. The normal may have any length but 0:
/// predicates use it as given, since dividing by its length would round. Radius 0 is a point light (with the
/// same one-sidedness).
struct DiskLight {
  Vec3 center{0.0};  ///< scene units
  Vec3 normal{0.0, -1.0, 0.0};
  double radius = 0.0;  ///< scene units, ≥ 0

  bool operator==(const DiskLight&) const = default;  ///< number by number
};

/// An orthonormal frame of the light: `w` along the normal; u × v = w. Deterministic in the normal's bits.
struct LightFrame {
  Vec3 u, v, w;
};
LightFrame light_frame(const DiskLight& light);

/// The disk's points with the largest and the smallest N·p: center ± radius · N⊥/|N⊥|, N⊥ = N - (N·m)m, m the
/// unit normal. Where N is parallel to m (or 0) every point is extreme and the center is returned for both.
/// The pnear and pfar of "Umbra and penumbra volumes" (2004), eq. 1, with sign and length corrected.
struct ExtremePoints {
  Vec3 near;  ///< the largest N·p: if the face does not look at this point, it looks at none
  Vec3 far;   ///< the smallest N·p: if the face looks at this point, it looks at all
};
ExtremePoints extreme_points(const DiskLight& light, const Vec3& plane_normal);

/// True where nothing of the light's front is seen: on or behind its plane, in plain double (images; topology
/// asks side_of_light_plane in predicates.h).
bool is_behind(const DiskLight& light, const Vec3& point);

}  // namespace penumbra
