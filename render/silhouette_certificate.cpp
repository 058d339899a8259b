#include "render/silhouette_certificate.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "render/silhouette_domain.h"

namespace penumbra::detail {
namespace {

constexpr double kHair = 0x1p-23;

}  // namespace

double certificate_slack(double extent) {
  return 1e-6 + 0x1p-26 * extent;
}

Projection see(const BandEdge& e, const Vec3& x, double slack) {
  const double left = e.left.value(x), right = e.has_right ? e.right.value(x) : 0.0;
  const int jump = (left > 0.0 ? 1 : -1) + (e.has_right ? (right > 0.0 ? -1 : 1) : 0);
  const bool sure = std::abs(left) > e.left.tolerance && std::abs(right) > e.right.tolerance;
  if (jump == 0 && sure) return {{}, false};

  // Where an end is not below the receiver, the point of the edge that is so by a hair.
  const double least = kHair * x.z;
  double wa = x.z - e.a.z, wb = x.z - e.b.z;
  if (!(wa > least) && !(wb > least)) return {{}, false};
  glm::dvec2 a(e.a), b(e.b);
  const double wa0 = wa, wb0 = wb;
  if (!(wa > least)) a += ((least - wa0) / (wb0 - wa0)) * (glm::dvec2(e.b) - a), wa = least;
  if (!(wb > least)) b += ((least - wb0) / (wa0 - wb0)) * (glm::dvec2(e.a) - b), wb = least;
  const glm::dvec2 from(x);
  const glm::dvec2 pa = from + (a - from) * (x.z / wa), pb = from + (b - from) * (x.z / wb);

  if (glm::dot(pa, pa) < 1.0 || glm::dot(pb, pb) < 1.0) return {{pa, pb, jump}, true};
  // Nearest point of the segment to the disk's centre.
  const glm::dvec2 s = pb - pa;
  const double length2 = glm::dot(s, s), along = -glm::dot(pa, s);
  const double t = along <= 0.0 ? 0.0 : (along >= length2 ? 1.0 : along / length2);
  const glm::dvec2 nearest = pa + t * s;
  return {{pa, pb, jump}, glm::dot(nearest, nearest) < (1.0 + slack) * (1.0 + slack)};
}

void look(const EdgeList& list, const Vec3& x, const Chord& horizon, double slack, Sight& out) {
  sift(list, x, out.sifted);
  out.segments.clear();
  out.certain = true;
  for (const std::uint32_t i : out.sifted) {
    const Projection p = see(list[i], x, slack);
    if (!p.near) continue;
    out.certain = false;
    if (p.segment.jump == 0) continue;
    if (!(height(horizon, p.segment.a) > 0.0) && !(height(horizon, p.segment.b) > 0.0)) continue;
    out.segments.push_back(p.segment);
  }
}

}  // namespace penumbra::detail
