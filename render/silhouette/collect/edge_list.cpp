#include "render/silhouette/collect/edge_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "render/support/float_lanes.h"

namespace penumbra::detail {
namespace {

// Speed.
/// Edges at a time: their marks stay in the cache. Seen in the benchmark `silhouette`, stage receivers.
constexpr std::size_t kChunk = 512;

/// A receiver: x, y, z in the light's frame, and dx, dy, dz from the tile's middle. `extent`: M.
struct FloatReceiver {
  float x, y, z, per_z, dx, dy, dz, extent;
};

FloatReceiver float_receiver(const EdgeList& list, const Vec3& x) {
  const Vec3 d = x - list.middle();
  return {static_cast<float>(x.x),       static_cast<float>(x.y),          static_cast<float>(x.z),
          static_cast<float>(1.0 / x.z), static_cast<float>(d.x),          static_cast<float>(d.y),
          static_cast<float>(d.z),       static_cast<float>(list.extent())};
}

/// The jump of an edge that has to be looked at, or kUnsure; 0 where it is dismissed. Without branches. A
/// face that is missing on the right has value 0 and tolerance -1: it is certain to be on neither side.
PENUMBRA_INLINE std::int32_t kept_jump(float ax, float ay, float az, float bx, float by, float bz, float size,
                                       float lx, float ly, float lz, float ld, float lt, float rx, float ry,
                                       float rz, float rd, float rt, const FloatReceiver& r) {
  // The jump.
  const float left = lx * r.dx + ly * r.dy + lz * r.dz + ld;
  const float right = rx * r.dx + ry * r.dy + rz * r.dz + rd;
  const bool sure = (std::abs(left) > lt) & (std::abs(right) > rt);
  const std::int32_t jump = (left > 0.0f ? 1 : -1) + (right > 0.0f ? -1 : 0) + (right < 0.0f ? 1 : 0);

  // The edge projected onto the disk, and whether it stays beside it.
  const float wa = r.dz - az, wb = r.dz - bz;
  const float w = wa < wb ? wa : wb;
  const float ga = r.z / wa, gb = r.z / wb;
  const float pax = r.x + (ax - r.dx) * ga, pay = r.y + (ay - r.dy) * ga;
  const float pbx = r.x + (bx - r.dx) * gb, pby = r.y + (by - r.dy) * gb;
  const float sx = pbx - pax, sy = pby - pay;
  const float length2 = sx * sx + sy * sy;
  const float along = -(pax * sx + pay * sy);
  const float across = pax * sy - pay * sx;
  const float g = ga > gb ? ga : gb;
  const float reach = 1.0f + 0x1p-19f * (r.extent + size * g * (1.0f + size * g * r.per_z));
  const float reach2 = reach * reach;
  const float a2 = pax * pax + pay * pay, b2 = pbx * pbx + pby * pby;
  const bool beside = (across * across > reach2 * length2 * 1.0001f) | ((along <= 0.0f) & (a2 > reach2)) |
                      ((along >= length2) & (b2 > reach2));

  // An edge that rises above the receiver is kept unless it lies above wholly.
  const float hair = 0x1p-20f * (r.extent + size);
  const bool above = (wa < -hair) & (wb < -hair);
  const bool below = w > hair;
  return (above | (below & beside)) ? 0 : (sure ? jump : TestedEdges::kUnsure);
}

/// A list's arrays.
struct Columns {
  explicit Columns(const EdgeList& l) {
    for (int c = 0; c < EdgeList::kColumns; ++c) at[c] = l.column(static_cast<EdgeList::Column>(c));
  }
  const float* at[EdgeList::kColumns];
};

/// `kept_jump` of edges first to first + count - 1.
PENUMBRA_VECTOR_CLONES
void test_range(const Columns& columns, std::size_t first, int count, const FloatReceiver& receiver,
                std::int32_t* __restrict jumps) {
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
    jumps[i] = kept_jump(ax[i], ay[i], az[i], bx[i], by[i], bz[i], size[i], lx[i], ly[i], lz[i], ld[i], lt[i],
                         rx[i], ry[i], rz[i], rd[i], rt[i], r);
}

/// The sides of a shaft in a list's coordinates: x px + y py + z pz + offset > grain (extent + size) outside.
struct FloatPlanes {
  FloatPlanes(const Shaft& shaft, const EdgeList& list) : extent(static_cast<float>(list.extent())) {
    for (int k = 0; k <= kShaftSides; ++k) {
      const Shaft::Side side = shaft.side_plane(k);
      x[k] = static_cast<float>(side.normal.x);
      y[k] = static_cast<float>(side.normal.y);
      z[k] = static_cast<float>(side.normal.z);
      offset[k] = static_cast<float>(glm::dot(side.normal, list.middle()) + side.offset);
      grain[k] = 0x1p-19f * static_cast<float>(1.0 + std::abs(side.normal.z));
    }
  }
  float x[kShaftSides + 1], y[kShaftSides + 1], z[kShaftSides + 1], offset[kShaftSides + 1],
      grain[kShaftSides + 1];
  float extent;
};

/// outside[i]: 1 where edge first + i lies beyond some plane, else 0.
PENUMBRA_VECTOR_CLONES
void mark_beyond(const Columns& columns, std::size_t first, int count, const FloatPlanes& planes,
                 std::int32_t* __restrict outside) {
  using L = EdgeList;
  const float* const* at = columns.at;
  const float *ax = at[L::kAx] + first, *ay = at[L::kAy] + first, *az = at[L::kAz] + first;
  const float *bx = at[L::kBx] + first, *by = at[L::kBy] + first, *bz = at[L::kBz] + first;
  const float* size = at[L::kSize] + first;
  for (int i = 0; i < count; ++i) {
    const float x0 = ax[i], y0 = ay[i], z0 = az[i], x1 = bx[i], y1 = by[i], z1 = bz[i];
    const float reach = planes.extent + size[i];
    std::int32_t beyond = 0;
#pragma GCC unroll 17
    for (int k = 0; k <= kShaftSides; ++k) {
      const float a = planes.x[k] * x0 + planes.y[k] * y0 + planes.z[k] * z0 + planes.offset[k];
      const float b = planes.x[k] * x1 + planes.y[k] * y1 + planes.z[k] * z1 + planes.offset[k];
      beyond |= (a < b ? a : b) > planes.grain[k] * reach ? 1 : 0;
    }
    outside[i] = beyond;
  }
}

/// Writes places and jumps where the jump is not 0, and returns how many. Up to seven more are written.
PENUMBRA_VECTOR_CLONES
std::size_t keep_some(const std::int32_t* places, const std::int32_t* jumps, std::size_t count,
                      std::int32_t* __restrict kept_places, std::int32_t* __restrict kept_jumps) {
  std::size_t found = 0, i = 0;
  for (; i + kFloatLanes <= count; i += kFloatLanes) {
    Ints place, jump;
    std::memcpy(&place, places + i, sizeof(place));
    std::memcpy(&jump, jumps + i, sizeof(jump));
    const std::uint32_t kept = bits_of(jump != 0);
    store_lanes(place, kept, kept_places + found);
    found += store_lanes(jump, kept, kept_jumps + found);
  }
  for (; i < count; ++i) {
    kept_places[found] = places[i];
    kept_jumps[found] = jumps[i];
    found += jumps[i] != 0 ? 1 : 0;
  }
  return found;
}

/// Sets outside[i] where both faces of edge first + i are on the same side for all receivers of a box.
PENUMBRA_VECTOR_CLONES
void mark_one_sided(const Columns& columns, std::size_t first, int count, float x, float y, float z, float hx,
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
    outside[i] |= ((std::abs(left) > l) & (std::abs(right) > r) & (left * right > 0.0f)) ? 1 : 0;
  }
}

/// The tolerance of a float sum n·d + offset, |d| ≤ reach.
float float_tolerance(const FacePlane& plane, double offset, double reach) {
  return static_cast<float>(plane.tolerance + 0x1p-20 * (std::abs(offset) + reach));
}

}  // namespace

void EdgeList::assign(const Band& band, std::span<const std::uint32_t> edges, const Vec3& middle) {
  tile_ = nullptr;
  middle_ = middle;
  extent_ = band.extent;
  edges_.resize(edges.size());
  ends_.resize(6 * edges.size());
  places_.resize(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const BandEdge& e = band.edges[edges[i]];
    edges_[i] = &e;
    places_[i] = static_cast<std::int32_t>(i);
    for (int k = 0; k < 3; ++k) ends_[6 * i + k] = e.a[k], ends_[6 * i + 3 + k] = e.b[k];
  }
  fill_columns();
}

void EdgeList::assign(const EdgeList& list, std::span<const std::uint32_t> indices) {
  tile_ = &list.tile();
  middle_ = list.middle_;
  extent_ = list.extent_;
  places_.resize(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) places_[i] = list.places_[indices[i]];
  for (int c = 0; c < kColumns; ++c) {
    columns_[c].resize(indices.size());
    const float* from = list.columns_[c].data();
    float* to = columns_[c].data();
    for (std::size_t i = 0; i < indices.size(); ++i) to[i] = from[indices[i]];
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
    if (!e.has_right()) columns_[kRd][i] = 0.0f, columns_[kRt][i] = -1.0f;
  }
}

std::size_t EdgeList::bytes() const {
  // NOLINTNEXTLINE(bugprone-sizeof-expression): edges_ holds pointers
  return edges_.capacity() * sizeof(edges_[0]) + ends_.capacity() * sizeof(ends_[0]) +
         places_.capacity() * sizeof(places_[0]) + kColumns * columns_[0].capacity() * sizeof(float);
}

void narrow(const EdgeList& list, const Shaft& shaft, std::vector<std::uint32_t>& out) {
  const Columns columns(list);
  const FloatPlanes planes(shaft, list);
  const glm::vec3 d(shaft.middle() - list.middle()), half(1.0001 * shaft.half());
  alignas(64) std::int32_t outside[kChunk];
  out.resize(list.size());
  std::size_t found = 0;
  for (std::size_t first = 0; first < list.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, list.size() - first);
    mark_beyond(columns, first, static_cast<int>(count), planes, outside);
    mark_one_sided(columns, first, static_cast<int>(count), d.x, d.y, d.z, half.x, half.y, half.z, outside);
    for (std::size_t i = 0; i < count; ++i) {
      out[found] = static_cast<std::uint32_t>(first + i);
      found += outside[i] == 0 ? 1 : 0;
    }
  }
  out.resize(found);
}

void test_edges(const EdgeList& list, const Vec3& x, TestedEdges& out) {
  const Columns columns(list);
  const FloatReceiver receiver = float_receiver(list, x);
  alignas(64) std::int32_t jumps[kChunk];
  out.places.resize(std::max(out.places.size(), list.size() + kFloatLanes));
  out.jumps.resize(out.places.size());
  std::size_t found = 0;
  for (std::size_t first = 0; first < list.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, list.size() - first);
    test_range(columns, first, static_cast<int>(count), receiver, jumps);
    found +=
        keep_some(list.places() + first, jumps, count, out.places.data() + found, out.jumps.data() + found);
  }
  out.count = found;
}

int test_edge(const EdgeList& list, std::size_t i, const Vec3& x) {
  std::int32_t jump = 0;
  test_range(Columns(list), i, 1, float_receiver(list, x), &jump);
  return jump;
}

}  // namespace penumbra::detail
