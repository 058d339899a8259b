#include "render/d_buffer/entries/entry_footprint.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

Uvw project(const Vec3& p) {
  return {glm::dvec2(p.x, p.y) / p.z, 1.0 / p.z};
}

constexpr float kUnlimited = std::numeric_limits<float>::infinity();

/// Accuracy. Boundaries are drawn so many times as far as rays found them to reach, since rays probe a few
/// points only (Resampler.LessensTheError, DBufferScenes).
constexpr double kMargin = 1.05;
/// Accuracy: the point of a sliver moves outward by at most so many dilations, lest it hide its neighbors.
constexpr double kLongestMiter = 3.0;

}  // namespace

LightSpace::LightSpace(const DiskLight& light, double scale_factor)
    : axes(light_frame(light)),
      center(light.center),
      scale(scale_factor),
      radius(light.radius * scale_factor) {}

Vec3 LightSpace::to_light(const Vec3& world) const {
  const Vec3 d = (world - center) * scale;
  return {glm::dot(d, axes.u), glm::dot(d, axes.v), glm::dot(d, axes.w)};
}

VertexId EntryFootprints::begin_of(const SupportFacet& f) const {
  const Edge& e = mesh_.edges()[index(f.edge)];
  return f.flipped ? e.to : e.from;
}

VertexId EntryFootprints::end_of(const SupportFacet& f) const {
  const Edge& e = mesh_.edges()[index(f.edge)];
  return f.flipped ? e.from : e.to;
}

std::optional<EntryFootprints::Facet> EntryFootprints::facet(std::uint32_t i, float reach,
                                                             double far_weight) const {
  const SupportFacet& f = supports_.facets[i];
  Vec3 pa = in_light_frame(begin_of(f)), pb = in_light_frame(end_of(f));
  if (!cut(pa, pb)) return std::nullopt;
  const Uvw a = project(pa), b = project(pb);
  const glm::dvec2 downhill{-std::cos(f.rim_angle), -std::sin(f.rim_angle)};
  const double reach_a = extent(a.w, reach, far_weight), reach_b = extent(b.w, reach, far_weight);
  const glm::dvec2 along = b.uv - a.uv;
  const double length = glm::length(along);
  const glm::dvec2 e = length > 1e-12 ? along / length : glm::dvec2(-downhill.y, downhill.x);
  glm::dvec2 out{-e.y, e.x};
  if (glm::dot(out, downhill) < 0.0) out = -out;
  const double da = dilation(a.uv), db = dilation(b.uv);
  const double top = std::max(a.w, b.w);
  const auto on_plane = [&](const glm::dvec2& uv) {
    return Uvw{uv, std::clamp(a.w - glm::dot(uv - a.uv, downhill) / space_.radius, 0.0, top)};
  };
  return Facet{{on_plane(a.uv - da * e - da * out), on_plane(b.uv + db * e - db * out),
                on_plane(b.uv + reach_b * downhill + db * e + db * out),
                on_plane(a.uv + reach_a * downhill - da * e + da * out)},
               a.w,
               b.w};
}

std::optional<EntryFootprints::Cone> EntryFootprints::cone(const ConeSector& cone, float reach,
                                                           double far_weight) const {
  const Vec3 p = in_light_frame(cone.vertex);
  if (p.z <= options_.near_depth) return std::nullopt;
  const Uvw apex = project(p);
  return Cone{apex, extent(apex.w, reach, far_weight) + dilation(apex.uv)};
}

std::optional<std::array<Uvw, 3>> EntryFootprints::gap(const GapFace& gap) const {
  const IndexedTriangle& t = mesh_.triangles()[index(gap.face)];
  std::array<Uvw, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = in_light_frame(VertexId{t[k]});
    if (p.z <= options_.near_depth) return std::nullopt;
    corners[k] = project(p);
  }
  grow(corners);
  return corners;
}

/// Moves a triangle's sides outward by the dilation; the points of slivers by at most kLongestMiter times as
/// much.
void EntryFootprints::grow(std::array<Uvw, 3>& corners) const {
  glm::dvec2 out[3];  // of the side from corner k to the next
  const auto next = [](std::size_t k) { return (k + 1) % 3; };
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = corners[next(k)].uv - corners[k].uv;
    const double length = glm::length(side);
    if (!(length > 0.0)) return;
    out[k] = glm::dvec2(side.y, -side.x) / length;
  }
  const glm::dvec2 middle = (corners[0].uv + corners[1].uv + corners[2].uv) / 3.0;
  const double turn = glm::dot(out[0], corners[0].uv - middle) < 0.0 ? -1.0 : 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 sum = turn * (out[k] + out[next(next(k))]);
    const double least = 2.0 / kLongestMiter;  // of |sum|: where the miter is as long as it may be
    const double size = std::max(glm::length(sum), 1e-9);
    corners[k].uv +=
        dilation(corners[k].uv) * (size > least ? 2.0 / (size * size) : kLongestMiter / size) * sum;
  }
}

/// A hemicube's texel covers more of (u, v) towards the horizon: 1 + |uv| times as much across, and more
/// along the radius; the smaller factor is taken, since too wide a facet hides its neighbors.
double EntryFootprints::dilation(const glm::dvec2& uv) const {
  return options_.dilation * (options_.grows_with_uv ? 1.0 + glm::length(uv) : 1.0);
}

/// How far in (u, v) the boundary extends from a point at 1/z = w before it meets a surface or the farthest
/// receiver.
double EntryFootprints::extent(double w, float reach, double far_weight) const {
  const double far = std::max(options_.far_weight, far_weight);
  return space_.radius * std::max(0.0, w - std::max(far, w / (kMargin * static_cast<double>(reach))));
}

/// Cuts the segment at the near depth; false where nothing is left.
bool EntryFootprints::cut(Vec3& a, Vec3& b) const {
  const double n = options_.near_depth;
  if (a.z < n && b.z < n) return false;
  if (a.z < n) a = b + (a - b) * ((b.z - n) / (b.z - a.z));
  if (b.z < n) b = a + (b - a) * ((a.z - n) / (a.z - b.z));
  return true;
}

std::vector<std::uint8_t> count_facet_probes(const EntryFootprints& footprints, const Supports& supports,
                                             const std::vector<GapFace>& gaps,
                                             const ReceiverGrid& receivers) {
  std::vector<std::uint8_t> probes(supports.facets.size());
  tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t i) {
    const auto f = footprints.facet(static_cast<std::uint32_t>(i), kUnlimited, 0.0);
    if (!f) return;
    const double least = receivers.least_weight(supports.facets[i].kind, uv_bounds_of(f->corners));
    const double length = glm::distance(f->corners[0].uv, f->corners[1].uv);
    if (least < std::max(f->from_weight, f->to_weight)) probes[i] = length < footprints.narrow() ? 1 : 3;
  });
  for (const GapFace& gap : gaps) {  // drawn where its facet is in sight
    const auto g = footprints.gap(gap);
    if (!g || probes[gap.facet] > 0) continue;
    const double nearest = std::max({(*g)[0].w, (*g)[1].w, (*g)[2].w});
    if (receivers.least_weight(SupportKind::kUmbra, uv_bounds_of(*g)) < nearest) probes[gap.facet] = 1;
  }
  return probes;
}

std::vector<std::uint8_t> count_cone_probes(const EntryFootprints& footprints, const Supports& supports,
                                            const ReceiverGrid& receivers) {
  std::vector<std::uint8_t> probes(supports.cones.size());
  tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t i) {
    const ConeSector& sector = supports.cones[i];
    const auto c = footprints.cone(sector, kUnlimited, 0.0);
    if (c && receivers.least_weight(sector.kind, uv_bounds_of(*c)) < c->apex.w)
      probes[i] = (sector.to_angle - sector.from_angle) * c->radius < footprints.narrow() ? 1 : 3;
  });
  return probes;
}

}  // namespace penumbra::detail
