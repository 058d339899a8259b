#include "render/silhouette_certificate.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "render/silhouette_domain.h"
#include "render/vector_clones.h"
#include "volumes/detail/vectors.h"

namespace penumbra::detail {
namespace {

constexpr double kHair = 0x1p-23;

/// The receiver: where it is, and the same from the tile's middle.
struct FloatReceiver {
  float x, y, z, dx, dy, dz, extent;
};

FloatReceiver float_receiver(const EdgeList& list, const Vec3& x) {
  const Vec3 d = x - list.middle();
  return {static_cast<float>(x.x),          static_cast<float>(x.y), static_cast<float>(x.z),
          static_cast<float>(d.x),          static_cast<float>(d.y), static_cast<float>(d.z),
          static_cast<float>(list.extent())};
}

/// Whether an edge has to be looked at, without branches. Products and sums as they stand: float.
PENUMBRA_INLINE std::int32_t is_kept(float ax, float ay, float az, float bx, float by, float bz, float size,
                                     float lx, float ly, float lz, float ld, float lt, float rx, float ry,
                                     float rz, float rd, float rt, const FloatReceiver& r) {
  const float left = lx * r.dx + ly * r.dy + lz * r.dz + ld;
  const float right = rx * r.dx + ry * r.dy + rz * r.dz + rd;
  // Both beyond their tolerance and of one sign: a jump of 0. An edge with one face has a right tolerance
  // that is never passed.
  const bool idle = ((left > lt) & (right > rt)) | ((-left > lt) & (-right > rt));

  const float wa = r.dz - az, wb = r.dz - bz;
  const float w = wa < wb ? wa : wb;
  const float ga = r.z / wa, gb = r.z / wb;
  const float pax = r.x + (ax - r.dx) * ga, pay = r.y + (ay - r.dy) * ga;
  const float pbx = r.x + (bx - r.dx) * gb, pby = r.y + (by - r.dy) * gb;
  const float sx = pbx - pax, sy = pby - pay;
  const float length2 = sx * sx + sy * sy;
  const float along = -(pax * sx + pay * sy);
  const float across = pax * sy - pay * sx;
  const float reach = 1.0f + 0x1p-19f * (r.extent + size * (ga > gb ? ga : gb) * (1.0f + size / w));
  const float reach2 = reach * reach;
  const float a2 = pax * pax + pay * pay, b2 = pbx * pbx + pby * pby;
  const bool beside = (across * across > reach2 * length2 * 1.0001f) | ((along <= 0.0f) & (a2 > reach2)) |
                      ((along >= length2) & (b2 > reach2));
  // An edge that rises above the receiver is left to the second pass unless it lies above wholly.
  const float hair = 0x1p-20f * (r.extent + size);
  const bool above = (wa < -hair) & (wb < -hair);
  const bool below = w > hair;
  return (idle | above | (below & beside)) ? 0 : 1;
}

struct Columns {
  explicit Columns(const EdgeList& l) {
    for (int c = 0; c < EdgeList::kColumns; ++c) at[c] = l.column(static_cast<EdgeList::Column>(c));
  }
  const float* at[EdgeList::kColumns];
};

/// kept[i] = 1 for edges first + i that have to be looked at, else 0.
PENUMBRA_VECTOR_CLONES
void sift_range(const Columns& columns, std::size_t first, int count, const FloatReceiver& receiver,
                std::int32_t* __restrict kept) {
  const FloatReceiver r = receiver;
  using L = EdgeList;
  const float* const* at = columns.at;
  const float *ax = at[L::kAx] + first, *ay = at[L::kAy] + first, *az = at[L::kAz] + first;
  const float *bx = at[L::kBx] + first, *by = at[L::kBy] + first, *bz = at[L::kBz] + first;
  const float *lx = at[L::kLx] + first, *ly = at[L::kLy] + first, *lz = at[L::kLz] + first;
  const float *rx = at[L::kRx] + first, *ry = at[L::kRy] + first, *rz = at[L::kRz] + first;
  const float *ld = at[L::kLd] + first, *lt = at[L::kLt] + first, *rd = at[L::kRd] + first;
  const float *rt = at[L::kRt] + first, *size = at[L::kSize] + first;
  for (int i = 0; i < count; ++i)
    kept[i] = is_kept(ax[i], ay[i], az[i], bx[i], by[i], bz[i], size[i], lx[i], ly[i], lz[i], ld[i], lt[i],
                      rx[i], ry[i], rz[i], rd[i], rt[i], r);
}

/// Tolerance for a float sum n·d + offset, |d| ≤ `reach`.
float float_tolerance(const FacePlane& plane, double offset, double reach) {
  return static_cast<float>(plane.tolerance + 0x1p-20 * (std::abs(offset) + reach));
}

}  // namespace

void EdgeList::assign(const Band& band, std::span<const std::uint32_t> edges, const Vec3& middle) {
  middle_ = middle;
  extent_ = band.extent;
  edges_.clear();
  for (const std::uint32_t e : edges) edges_.push_back(&band.edges[e]);
  for (auto& c : columns_) c.assign(edges_.size(), 0.0f);
  const auto put_plane = [&](const FacePlane& plane, std::size_t i, Column first) {
    const double offset = plane.value(middle);
    for (int k = 0; k < 3; ++k) columns_[first + k][i] = static_cast<float>(plane.normal[k]);
    columns_[first + 3][i] = static_cast<float>(offset);
    columns_[first + 4][i] = float_tolerance(plane, offset, 4.0 * band.extent);
  };
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const BandEdge& e = *edges_[i];
    const Vec3 a = e.a - middle, b = e.b - middle;
    for (int k = 0; k < 3; ++k) {
      columns_[kAx + k][i] = static_cast<float>(a[k]);
      columns_[kBx + k][i] = static_cast<float>(b[k]);
    }
    columns_[kSize][i] = static_cast<float>(std::max(largest_component(a), largest_component(b)));
    put_plane(e.left, i, kLx);
    if (e.has_right) put_plane(e.right, i, kRx);
    if (!e.has_right) columns_[kRt][i] = std::numeric_limits<float>::infinity();
  }
}

std::size_t EdgeList::bytes() const {
  return edges_.capacity() * sizeof(edges_[0]) + kColumns * columns_[0].capacity() * sizeof(float);
}

void sift(const EdgeList& list, const Vec3& x, std::vector<std::uint32_t>& out) {
  constexpr std::size_t kChunk = 512;
  const Columns columns(list);
  const FloatReceiver receiver = float_receiver(list, x);
  alignas(64) std::int32_t kept[kChunk];
  out.resize(list.size());
  std::size_t found = 0;
  for (std::size_t first = 0; first < list.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, list.size() - first);
    sift_range(columns, first, static_cast<int>(count), receiver, kept);
    for (std::size_t i = 0; i < count; ++i) {
      out[found] = static_cast<std::uint32_t>(first + i);
      found += static_cast<std::size_t>(kept[i]);
    }
  }
  out.resize(found);
}

bool sift_one(const EdgeList& list, std::size_t i, const Vec3& x) {
  std::int32_t kept = 0;
  sift_range(Columns(list), i, 1, float_receiver(list, x), &kept);
  return kept != 0;
}

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
