#include "render/silhouette_certificate.h"

#include <cmath>

#include "render/silhouette_domain.h"
#include "render/vector_clones.h"

namespace penumbra::detail {
namespace {

constexpr double kHair = 0x1p-23;

/// One edge's numbers, by value: the body of both loops.
struct EdgeSeen {
  double ax, ay, bx, by;
  float jump;
  bool near;
};

struct Columns {
  explicit Columns(const EdgeList& l)
      : ax(l.column(EdgeList::kAx)),
        ay(l.column(EdgeList::kAy)),
        az(l.column(EdgeList::kAz)),
        bx(l.column(EdgeList::kBx)),
        by(l.column(EdgeList::kBy)),
        bz(l.column(EdgeList::kBz)),
        lx(l.column(EdgeList::kLx)),
        ly(l.column(EdgeList::kLy)),
        lz(l.column(EdgeList::kLz)),
        ld(l.column(EdgeList::kLd)),
        lt(l.column(EdgeList::kLt)),
        rx(l.column(EdgeList::kRx)),
        ry(l.column(EdgeList::kRy)),
        rz(l.column(EdgeList::kRz)),
        rd(l.column(EdgeList::kRd)),
        rt(l.column(EdgeList::kRt)),
        right(l.column(EdgeList::kRight)) {}
  const double *ax, *ay, *az, *bx, *by, *bz, *lx, *ly, *lz, *ld, *lt, *rx, *ry, *rz, *rd, *rt, *right;
};

inline EdgeSeen see(const Columns& e, std::size_t i, double x, double y, double z, double reach2) {
  const double left = e.lx[i] * x + e.ly[i] * y + e.lz[i] * z + e.ld[i];
  const double right = e.rx[i] * x + e.ry[i] * y + e.rz[i] * z + e.rd[i];
  const double jump = (left > 0.0 ? 1.0 : -1.0) + (right > 0.0 ? -e.right[i] : e.right[i]);
  const bool sure = (std::abs(left) > e.lt[i]) & (std::abs(right) > e.rt[i]);

  const double least = kHair * z;
  const double wa = z - e.az[i], wb = z - e.bz[i];
  const double dx = e.bx[i] - e.ax[i], dy = e.by[i] - e.ay[i], dw = wb - wa;
  // Where an end is not below the receiver, the point of the edge that is so by a hair.
  const double ta = wa < least ? (least - wa) / dw : 0.0;
  const double tb = wb < least ? (least - wa) / dw : 1.0;
  const double ca = wa < least ? least : wa, cb = wb < least ? least : wb;
  const double ex = tb < 1.0 ? e.ax[i] + tb * dx : e.bx[i], ey = tb < 1.0 ? e.ay[i] + tb * dy : e.by[i];
  const double ga = z / ca, gb = z / cb;
  const double pax = x + (e.ax[i] + ta * dx - x) * ga, pay = y + (e.ay[i] + ta * dy - y) * ga;
  const double pbx = x + (ex - x) * gb, pby = y + (ey - y) * gb;

  // Nearest point of the segment to the disk's centre.
  const double sx = pbx - pax, sy = pby - pay;
  const double length2 = sx * sx + sy * sy;
  const double along = -(pax * sx + pay * sy);
  const double t = along <= 0.0 ? 0.0 : (along >= length2 ? 1.0 : along / length2);
  const double nx = pax + t * sx, ny = pay + t * sy;
  const bool meets = (nx * nx + ny * ny < reach2) & ((wa > least) | (wb > least));
  return {pax, pay, pbx, pby, static_cast<float>(jump), meets && (jump != 0.0 || !sure)};
}

inline void put(const EdgeSeen& seen, std::size_t i, double* ax, double* ay, double* bx, double* by,
                float* jump, std::uint8_t* near) {
  ax[i] = seen.ax, ay[i] = seen.ay, bx[i] = seen.bx, by[i] = seen.by;
  jump[i] = seen.jump;
  near[i] = seen.near;
}

PENUMBRA_VECTOR_CLONES
void project_range(const Columns& e, std::size_t count, double x, double y, double z, double reach2,
                   double* __restrict ax, double* __restrict ay, double* __restrict bx, double* __restrict by,
                   float* __restrict jump, std::uint8_t* __restrict near) {
  const Columns c = e;
  for (std::size_t i = 0; i < count; ++i) put(see(c, i, x, y, z, reach2), i, ax, ay, bx, by, jump, near);
}

}  // namespace

void EdgeList::assign(const Band& band, std::span<const std::uint32_t> edges) {
  size_ = edges.size();
  for (auto& c : columns_) c.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) {
    const BandEdge& e = band.edges[edges[i]];
    const double row[kColumns] = {e.a.x,
                                  e.a.y,
                                  e.a.z,
                                  e.b.x,
                                  e.b.y,
                                  e.b.z,
                                  e.left.normal.x,
                                  e.left.normal.y,
                                  e.left.normal.z,
                                  e.left.offset,
                                  e.left.tolerance,
                                  e.right.normal.x,
                                  e.right.normal.y,
                                  e.right.normal.z,
                                  e.right.offset,
                                  e.right.tolerance,
                                  e.has_right ? 1.0 : 0.0};
    for (int c = 0; c < kColumns; ++c) columns_[c][i] = row[c];
  }
}

void Projections::resize(std::size_t n) {
  if (ax.size() >= n) return;
  for (auto* v : {&ax, &ay, &bx, &by}) v->resize(n);
  jump.resize(n);
  near.resize(n);
}

double certificate_slack(double extent) {
  return 1e-6 + 0x1p-26 * extent;
}

void project_edges(const EdgeList& list, const Vec3& x, double slack, Projections& out) {
  out.resize(list.size());
  project_range(Columns(list), list.size(), x.x, x.y, x.z, (1.0 + slack) * (1.0 + slack), out.ax.data(),
                out.ay.data(), out.bx.data(), out.by.data(), out.jump.data(), out.near.data());
}

void project_edge(const EdgeList& list, std::size_t i, const Vec3& x, double slack, Projections& out) {
  out.resize(list.size());
  put(see(Columns(list), i, x.x, x.y, x.z, (1.0 + slack) * (1.0 + slack)), i, out.ax.data(), out.ay.data(),
      out.bx.data(), out.by.data(), out.jump.data(), out.near.data());
}

void select_segments(const Projections& p, std::size_t count, const Chord& horizon, Sight& out) {
  out.segments.clear();
  out.certain = true;
  for (std::size_t i = 0; i < count; ++i) {
    if (!p.near[i]) continue;
    out.certain = false;
    if (p.jump[i] == 0.0f) continue;
    const glm::dvec2 a{p.ax[i], p.ay[i]}, b{p.bx[i], p.by[i]};
    if (!(height(horizon, a) > 0.0) && !(height(horizon, b) > 0.0)) continue;
    out.segments.push_back({a, b, static_cast<int>(p.jump[i])});
  }
}

}  // namespace penumbra::detail
