#include "render/silhouette_list.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/vector_clones.h"
#include "volumes/detail/vectors.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kChunk = 512;  // edges at a time

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

/// Adds to outside[i] where edge first + i lies beyond the plane x·px + y·py + z·pz + offset = 0.
PENUMBRA_VECTOR_CLONES
void mark_beyond(const Columns& columns, std::size_t first, int count, float x, float y, float z,
                 float offset, float extent, float grain, std::int32_t* __restrict outside) {
  using L = EdgeList;
  const float* const* at = columns.at;
  const float *ax = at[L::kAx] + first, *ay = at[L::kAy] + first, *az = at[L::kAz] + first;
  const float *bx = at[L::kBx] + first, *by = at[L::kBy] + first, *bz = at[L::kBz] + first;
  const float* size = at[L::kSize] + first;
  for (int i = 0; i < count; ++i) {
    const float a = x * ax[i] + y * ay[i] + z * az[i] + offset;
    const float b = x * bx[i] + y * by[i] + z * bz[i] + offset;
    const float margin = grain * (extent + size[i]);
    outside[i] += ((a > margin) & (b > margin)) ? 1 : 0;
  }
}

/// Adds to outside[i] where both faces of edge first + i keep their sides over a box, and the jump is 0.
PENUMBRA_VECTOR_CLONES
void mark_idle(const Columns& columns, std::size_t first, int count, float x, float y, float z, float hx,
               float hy, float hz, std::int32_t* __restrict outside) {
  using L = EdgeList;
  const float* const* at = columns.at;
  const float *lx = at[L::kLx] + first, *ly = at[L::kLy] + first, *lz = at[L::kLz] + first;
  const float *rx = at[L::kRx] + first, *ry = at[L::kRy] + first, *rz = at[L::kRz] + first;
  const float *ld = at[L::kLd] + first, *lt = at[L::kLt] + first, *rd = at[L::kRd] + first;
  const float* rt = at[L::kRt] + first;
  for (int i = 0; i < count; ++i) {
    const float left = lx[i] * x + ly[i] * y + lz[i] * z + ld[i];
    const float right = rx[i] * x + ry[i] * y + rz[i] * z + rd[i];
    const float l = lt[i] + std::abs(lx[i]) * hx + std::abs(ly[i]) * hy + std::abs(lz[i]) * hz;
    const float r = rt[i] + std::abs(rx[i]) * hx + std::abs(ry[i]) * hy + std::abs(rz[i]) * hz;
    outside[i] += (((left > l) & (right > r)) | ((-left > l) & (-right > r))) ? 1 : 0;
  }
}

/// The shaft's planes and the idle test, over one chunk.
void mark_outside(const EdgeList& list, const Columns& columns, std::size_t first, int count,
                  const Shaft& shaft, std::int32_t* outside) {
  const auto extent = static_cast<float>(list.extent());
  std::fill(outside, outside + count, 0);
  for (int k = 0; k < kShaftSides + 1; ++k) {
    const Shaft::Side side = shaft.side_plane(k);
    const double offset = glm::dot(side.normal, list.middle()) + side.offset;
    mark_beyond(columns, first, count, static_cast<float>(side.normal.x), static_cast<float>(side.normal.y),
                static_cast<float>(side.normal.z), static_cast<float>(offset), extent,
                0x1p-19f * static_cast<float>(1.0 + std::abs(side.normal.z)), outside);
  }
  const Vec3 d = shaft.middle() - list.middle(), half = 1.0001 * shaft.half();
  mark_idle(columns, first, count, static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
            static_cast<float>(half.x), static_cast<float>(half.y), static_cast<float>(half.z), outside);
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
  fill_columns();
}

void EdgeList::assign(const EdgeList& list, std::span<const std::uint32_t> places) {
  middle_ = list.middle_;
  extent_ = list.extent_;
  edges_.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) edges_[i] = list.edges_[places[i]];
  for (int c = 0; c < kColumns; ++c) {
    columns_[c].resize(places.size());
    const float* from = list.columns_[c].data();
    float* to = columns_[c].data();
    for (std::size_t i = 0; i < places.size(); ++i) to[i] = from[places[i]];
  }
}

void EdgeList::fill_plane(const FacePlane& plane, std::size_t i, Column first) {
  const double offset = plane.value(middle_);
  for (int k = 0; k < 3; ++k) columns_[first + k][i] = static_cast<float>(plane.normal[k]);
  columns_[first + 3][i] = static_cast<float>(offset);
  columns_[first + 4][i] = float_tolerance(plane, offset, 4.0 * extent_);
}

void EdgeList::fill_columns() {
  for (auto& c : columns_) c.resize(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const BandEdge& e = *edges_[i];
    const Vec3 a = e.a - middle_, b = e.b - middle_;
    for (int k = 0; k < 3; ++k) {
      columns_[kAx + k][i] = static_cast<float>(a[k]);
      columns_[kBx + k][i] = static_cast<float>(b[k]);
    }
    columns_[kSize][i] = static_cast<float>(std::max(largest_component(a), largest_component(b)));
    fill_plane(e.left, i, kLx);
    fill_plane(e.right, i, kRx);
    if (!e.has_right) columns_[kRt][i] = std::numeric_limits<float>::infinity();
  }
}

std::size_t EdgeList::bytes() const {
  return edges_.capacity() * sizeof(edges_[0]) + kColumns * columns_[0].capacity() * sizeof(float);
}

void narrow(const EdgeList& list, const Shaft& shaft, std::vector<std::uint32_t>& out) {
  const Columns columns(list);
  alignas(64) std::int32_t outside[kChunk];
  out.clear();
  for (std::size_t first = 0; first < list.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, list.size() - first);
    mark_outside(list, columns, first, static_cast<int>(count), shaft, outside);
    for (std::size_t i = 0; i < count; ++i)
      if (outside[i] == 0) out.push_back(static_cast<std::uint32_t>(first + i));
  }
}

void sift(const EdgeList& list, const Vec3& x, std::vector<std::uint32_t>& out) {
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

}  // namespace penumbra::detail
