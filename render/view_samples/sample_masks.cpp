#include "render/view_samples/sample_masks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// What takes places on the light to the world and to the unit disk, and the receiver.
struct Axes {
  Vec3 center, u, v, normal;
  glm::dvec2 unit_u, unit_v, x;
  bool horizon;
};

struct Lanes {
  float *a, *b;
  double *x, *y;
  std::int64_t* hidden;
};

PENUMBRA_VECTOR_CLONES
void place(const StratumTable& table, bool disk, std::uint32_t key, const Axes& axes, std::size_t count,
           const Lanes& out) {
  const Vec3 c = axes.center, u = axes.u, v = axes.v, n = axes.normal;
  const double ux = axes.unit_u.x, uy = axes.unit_u.y, vx = axes.unit_v.x, vy = axes.unit_v.y;
  const double px = axes.x.x, py = axes.x.y, lowest = axes.horizon ? 0.0 : -1.0;
  for (std::size_t first = 0; first < count; first += kSampleLanes) {
    float *a = out.a + first, *b = out.b + first;
    place_samples(table, disk, key, static_cast<int>(first), a, b);
    for (int k = 0; k < kSampleLanes; ++k) {
      const double s = a[k], t = b[k];
      out.x[first + static_cast<std::size_t>(k)] = ux * s + vx * t - px;
      out.y[first + static_cast<std::size_t>(k)] = uy * s + vy * t - py;
      const double x = c.x + u.x * s + v.x * t, y = c.y + u.y * s + v.y * t, z = c.z + u.z * s + v.z * t;
      out.hidden[first + static_cast<std::size_t>(k)] = n.x * x + n.y * y + n.z * z > lowest ? 0 : -1;
    }
  }
}

/// Returns how many are left.
PENUMBRA_VECTOR_CLONES
std::int64_t hide_behind(const FaceCone& cone, const double* __restrict x, const double* __restrict y,
                         double z, std::size_t count, std::int64_t* __restrict hidden) {
  const double abx = cone.ab.x, aby = cone.ab.y, abz = cone.ab.z * z;
  const double bcx = cone.bc.x, bcy = cone.bc.y, bcz = cone.bc.z * z;
  const double cax = cone.ca.x, cay = cone.ca.y, caz = cone.ca.z * z;
  const double least = cone.reaches_behind ? cone.depth : -1.0;
  std::int64_t left = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double ab = abx * x[i] + aby * y[i] + abz, bc = bcx * x[i] + bcy * y[i] + bcz,
                 ca = cax * x[i] + cay * y[i] + caz;
    const bool behind = (ab >= 0.0) & (bc >= 0.0) & (ca >= 0.0) & (ab + bc + ca > least);
    hidden[i] |= behind ? std::int64_t{-1} : std::int64_t{0};
    left += hidden[i] + 1;
  }
  return left;
}

}  // namespace

FaceCone::FaceCone(const FaceCorners& face, const Vec3& x) {
  const Vec3 a = face.a - x, b = face.b - x, c = face.c - x;
  ab = glm::cross(a, b);
  bc = glm::cross(b, c);
  ca = glm::cross(c, a);
  depth = glm::dot(bc, a);
  depth_error = 0x1p-48 * largest_component(a) * largest_component(b) * largest_component(c);
  if (depth < 0.0) {
    depth = -depth;
    ab = -ab, bc = -bc, ca = -ca;
  }
  reaches_behind = !(face.a.z > 0.0 && face.b.z > 0.0 && face.c.z > 0.0);
}

Cover FaceCone::cover(const Vec3& x) const {
  constexpr double kRounding = 1e-12;
  Cover out = reaches_behind ? Cover::kSome : Cover::kAll;
  for (const Vec3& n : {ab, bc, ca}) {
    const double middle = -glm::dot(n, x), reach = std::sqrt(n.x * n.x + n.y * n.y);
    const double margin =
        kRounding * (std::abs(n.x * x.x) + std::abs(n.y * x.y) + std::abs(n.z * x.z) + reach);
    if (middle + reach < -margin) return Cover::kNone;
    if (middle - reach < margin) out = Cover::kSome;
  }
  return out;
}

SampleMasks::SampleMasks(const AreaLight& light, const UnitLight& unit, int samples)
    : light_(light),
      table_(samples),
      u_(light.axes.u * light.half.x),
      v_(light.axes.v * light.half.y),
      a_(table_.columns.size(), 0.0f),
      b_(a_),
      x_(a_.size(), 0.0),
      y_(x_),
      hidden_(a_.size(), 0) {
  const Vec3 across = unit.offset_on_disk({1.0, 0.0}), up = unit.offset_on_disk({0.0, 1.0});
  const double radius2 = glm::dot(across, across);
  unit_u_ = glm::dvec2(glm::dot(u_, across), glm::dot(u_, up)) / radius2;
  unit_v_ = glm::dvec2(glm::dot(v_, across), glm::dot(v_, up)) / radius2;
}

void SampleMasks::begin(const MaskReceiver& receiver) {
  const Axes axes{
      receiver.to_center,          u_, v_, receiver.normal, unit_u_, unit_v_, glm::dvec2(receiver.x),
      receiver.normal != Vec3(0.0)};
  place(table_, light_.disk, receiver.key, axes, x_.size(),
        {a_.data(), b_.data(), x_.data(), y_.data(), hidden_.data()});
  std::fill(hidden_.begin() + count(), hidden_.end(), std::int64_t{-1});
  z_ = -receiver.x.z;
}

bool SampleMasks::hide(const FaceCone& cone) {
  return hide_behind(cone, x_.data(), y_.data(), z_, x_.size(), hidden_.data()) > 0;
}

int SampleMasks::visible() const {
  return static_cast<int>(std::ranges::count(hidden_, std::int64_t{0}));
}

}  // namespace penumbra::detail
