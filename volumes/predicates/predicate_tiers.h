// The tiers of predicates.h one by one, for tests and for tallies. The tiers `filter` and `interval` return
// nothing where they cannot decide. Whatever they return agrees with the tier `exact`.
#pragma once

#include <array>
#include <optional>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

/// Plain double with a derived bound on its error (volumes/predicates/filtered.h).
namespace filter {
std::optional<FaceClass> classify_face(const Vec3& a, const Vec3& b, const Vec3& c,
                                       const CircularLight& light);
std::optional<Sign> orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
std::optional<Sign> side_of_light_plane(const Vec3& p, const CircularLight& light);
std::optional<Sign> line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light);
std::optional<std::array<Sign, 2>> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                                           const CircularLight& light);
std::optional<bool> collinear(const Vec3& a, const Vec3& b, const Vec3& c);
}  // namespace filter

/// Interval arithmetic on doubles (CGAL::Interval_nt).
namespace interval {
std::optional<FaceClass> classify_face(const Vec3& a, const Vec3& b, const Vec3& c,
                                       const CircularLight& light);
std::optional<Sign> orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
std::optional<Sign> side_of_light_plane(const Vec3& p, const CircularLight& light);
std::optional<Sign> line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light);
std::optional<std::array<Sign, 2>> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                                           const CircularLight& light);
std::optional<bool> collinear(const Vec3& a, const Vec3& b, const Vec3& c);
}  // namespace interval

/// Exact arithmetic on the doubles as given.
namespace exact {
FaceClass classify_face(const Vec3& a, const Vec3& b, const Vec3& c, const CircularLight& light);
Sign orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
Sign side_of_light_plane(const Vec3& p, const CircularLight& light);
Sign line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light);
std::array<Sign, 2> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                            const CircularLight& light);
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);
}  // namespace exact

/// Whether a, b and c lie on one line (where two are equal they do). Asks all tiers.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace penumbra::detail
