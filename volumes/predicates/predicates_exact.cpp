// The second and third tier of predicates.h. Compiled with -frounding-math, since intervals are computed
// under directed rounding.
#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include "volumes/predicates/predicate_forms.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra::detail {

namespace {

using Interval =
    CGAL::Interval_nt<false>;  // "false": the rounding mode is set once a predicate, by RoundUpwards

#ifdef CGAL_HAS_MPZF
using Exact = CGAL::Mpzf;  // integers with a binary exponent: all that sums and products of doubles need
#else
using Exact = CGAL::Gmpq;
#endif

using RoundUpwards = CGAL::Protect_FPU_rounding<true>;

Sign to_sign(CGAL::Sign sign) {
  return sign == CGAL::ZERO ? Sign::kZero : (sign == CGAL::POSITIVE ? Sign::kPositive : Sign::kNegative);
}

struct IntervalArithmetic {
  static Interval value(double x) { return Interval(x); }
  static Interval difference(double x, double y) { return Interval(x) - Interval(y); }
  static std::optional<Sign> sign(const Interval& x) {
    const CGAL::Uncertain<CGAL::Sign> result = CGAL::sign(x);
    return result.is_certain() ? std::optional(to_sign(result.make_certain())) : std::nullopt;
  }
};

struct ExactArithmetic {
  static Exact value(double x) { return Exact(x); }
  static Exact difference(double x, double y) { return Exact(x) - Exact(y); }
  static std::optional<Sign> sign(const Exact& x) { return to_sign(CGAL::sign(x)); }
};

}  // namespace

namespace interval {

std::optional<FaceClass> classify_face(const Vec3& a, const Vec3& b, const Vec3& c,
                                       const CircularLight& light) {
  const RoundUpwards protect;
  return classify_face_in<IntervalArithmetic>(a, b, c, light);
}

std::optional<Sign> orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const RoundUpwards protect;
  return orient3d_in<IntervalArithmetic>(a, b, c, d);
}

std::optional<Sign> side_of_light_plane(const Vec3& p, const CircularLight& light) {
  const RoundUpwards protect;
  return side_of_light_plane_in<IntervalArithmetic>(p, light);
}

std::optional<Sign> line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light) {
  const RoundUpwards protect;
  return line_outside_disk_in<IntervalArithmetic>(a, b, light);
}

std::optional<std::array<Sign, 2>> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                                           const CircularLight& light) {
  const RoundUpwards protect;
  return sides_of_tangent_planes_in<IntervalArithmetic>(a, b, q, light);
}

std::optional<bool> collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  const RoundUpwards protect;
  return collinear_in<IntervalArithmetic>(a, b, c);
}

}  // namespace interval

namespace exact {

FaceClass classify_face(const Vec3& a, const Vec3& b, const Vec3& c, const CircularLight& light) {
  return *classify_face_in<ExactArithmetic>(a, b, c, light);
}

Sign orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return *orient3d_in<ExactArithmetic>(a, b, c, d);
}

Sign side_of_light_plane(const Vec3& p, const CircularLight& light) {
  return *side_of_light_plane_in<ExactArithmetic>(p, light);
}

Sign line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light) {
  return *line_outside_disk_in<ExactArithmetic>(a, b, light);
}

std::array<Sign, 2> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                            const CircularLight& light) {
  return *sides_of_tangent_planes_in<ExactArithmetic>(a, b, q, light);
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return *collinear_in<ExactArithmetic>(a, b, c);
}

}  // namespace exact

}  // namespace penumbra::detail
