// What Embree asks at every hit: does it count? Float answers where it can, double and exact predicates
// elsewhere.
//
// Let x be the receiver, q the light point, u = 2^-24. The float ray p = o + t·d misses x and q by some
// roundings of the frame's coordinates, each at most u/2 for coordinates up to 1 and u for those beyond.
// Embree ("robust") takes a face's corners relative to o, rounded once, and computes t = T/D from T = v·N, D
// = d·N, N = e × e', with v a corner and e, e' edges of those. With L the longest edge, |v| ≤ 4, |t| ≤ 4 and
// |N| ≤ L²
//
//   corners, o, d and v displace face and ray against each other by less than 12u: by 12u |N| in T,
//   e, e' are rounded to u L, hence N to 6u L²: 24u L² in T and in t·D,
//   both products are rounded three times: 12u L² each,
//
// so the hit lies on the side of x that t tells where |t - t_x| |D| > 96u L², and likewise for q. Twice that
// is asked for (kClear). D is small where the ray grazes the face. All other hits are decided by
// segment_face.h, in world coordinates.
//
// A face's border is as much in doubt: float may take a ray that passes by for one that hits, or, worse, the
// other way round. So the faces that Embree is given are grown in their planes by some 64u on every side, g,
// more than float misplaces an edge; by less where faces are so small that many would overlap. A hit that
// lies within the face by g and by that error is clear. It lies w |N| / e from a side of length e with the
// barycentric coordinate w, and the error is divided by the sine at which the ray meets the face, |D| / (|N|
// |d|), so w |D| > 7/4 (g + error) L suffices, |d| < 7/4.
//
// Where a ray grazes the surface, sides are misplaced by more than g. So where a face is reported by float
// but not met, its neighbors are looked at (segment_face.h); and where a ray leaves its own face as flat,
// those of that face, in case float passes over all that lies on the way. What is left to float are rays that
// graze both faces of a silhouette.
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "render/rays/ray_scene_impl.h"

namespace penumbra::detail {

/// Accuracy (tests ExactRays).
inline constexpr double kClear = 0x1p-24 * 192.0;
/// Accuracy and speed: g, and how much of the mean edge it is at most.
inline constexpr double kMostGrown = 0x1p-18, kLeastGrown = 0x1p-21, kGrownOfEdge = 0x1p-6;

/// Accuracy and speed. Sines at which a ray grazes a face that it misses, and its own; how far the surface is
/// followed beside the ray, in the frame.
inline constexpr double kGrazing = 0.25, kLeavesFlat = 0x1p-6, kBeside = 0x1p-18;

/// The nearest face so far.
struct NearestHit {
  const RayGeometry* geometry = nullptr;  ///< none: no face
  std::uint32_t face = 0;                 ///< of the mesh
  float at = 0.0f, error = 0.0f;          ///< on the float ray, and how far off that may be
};

/// Context of a call to Embree. Refers to everything.
struct HitQuery {
  HitQuery(const RayPacket& packet, const GroupRays& rays, const RayGroup& group,
           RTCIntersectContextFlags flags);

  RTCIntersectContext context;  ///< first: Embree hands its address to the filters
  const RayPacket& packet;
  const GroupRays& rays;
  const RayGroup& group;
  /// One a ray; for filter_nearest.
  NearestHit* nearest = nullptr;
};

/// The sine at which a way meets a face is less than that.
bool is_flat(const FaceCorners& face, const Vec3& way, double sine);

/// Where the ray meets the face's plane, in units of its way, in double. Not finite where it runs along the
/// plane.
double distance_to(const RayGeometry& geometry, std::uint32_t face, const Vec3& from, const Vec3& way);

/// The ends of ray k, in world coordinates times the group's scale. That of an endless ray lies beyond the
/// group's box.
struct SegmentEnds {
  Vec3 x, q;
};
SegmentEnds ends_of(const RayPacket& packet, std::size_t k, const GroupFrame& frame);

/// Embree's filters: for occlusion, and for the first face that is met.
void filter_occluded(const RTCFilterFunctionNArguments* arguments);
void filter_nearest(const RTCFilterFunctionNArguments* arguments);

/// The first face of the group that each of the rays meets which `rays.set` has left valid.
void find_nearest(const RayGroup& group, const RayPacket& packet, GroupRays& rays,
                  std::span<NearestHit, RayPacket::kRays> out);

}  // namespace penumbra::detail
