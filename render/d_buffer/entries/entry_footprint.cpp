#include "render/d_buffer/entries/entry_footprint.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/d_buffer/view/window_clip.h"

namespace penumbra::detail {
namespace {

constexpr double kUnlimited = -std::numeric_limits<double>::infinity();

/// Accuracy. Boundaries are drawn farther than rays found them to reach by this part, since rays probe a few
/// points only (Resampler.LessensTheError, DBufferScenes).
constexpr double kMargin = 0.1;
/// Keeps of a segment what is in front of a plane, by the ends' distances from it; false where nothing is
/// left.
bool cut(glm::dvec4& a, glm::dvec4& b, double da, double db) {
  if (!(da >= 0.0 || db >= 0.0)) return false;
  if (da < 0.0) a = b + (a - b) * (db / (db - da));
  if (db < 0.0) b = a + (b - a) * (da / (da - db));
  return true;
}

/// Accuracy: the point of a sliver moves outward by at most so many dilations, lest it hide its neighbors.
constexpr double kLongestMiter = 3.0;

}  // namespace

VertexId EntryFootprints::begin_of(const SupportFacet& f) const {
  const Edge& e = mesh_.edges()[index(f.edge)];
  return f.flipped ? e.to : e.from;
}

VertexId EntryFootprints::end_of(const SupportFacet& f) const {
  const Edge& e = mesh_.edges()[index(f.edge)];
  return f.flipped ? e.from : e.to;
}

/// From where receivers at the height 0 and above, within the window, see the disk: at most h beyond the
/// window. As much again is kept on every side. What lies below all receivers hides nothing.
std::optional<EntryFootprints::Segment> EntryFootprints::segment(VertexId from, VertexId to) const {
  glm::dvec4 a = space_.homogeneous(mesh_.position(from)), b = space_.homogeneous(mesh_.position(to));
  const glm::dvec4 first = a, last = b;
  if (!cut(a, b, a.w - LightSpace::kNearWeight, b.w - LightSpace::kNearWeight)) return std::nullopt;
  const double half = options_.half_window;
  const glm::dvec4 planes[] = {{0.0, 0.0, 1.0, half},
                               {1.0, 0.0, 1.0, 2.0 * half},
                               {-1.0, 0.0, 1.0, 2.0 * half},
                               {0.0, 1.0, 1.0, 2.0 * half},
                               {0.0, -1.0, 1.0, 2.0 * half}};
  for (const glm::dvec4& plane : planes)
    if (!options_.is_hemicube && !cut(a, b, glm::dot(plane, a), glm::dot(plane, b))) return std::nullopt;
  return Segment{divided(a), divided(b), a == first, b == last};
}

std::optional<EntryFootprints::Facet> EntryFootprints::facet(std::uint32_t i, double end,
                                                             double far_height) const {
  const SupportFacet& f = supports_.facets[i];
  const std::optional<Segment> edge = segment(begin_of(f), end_of(f));
  if (!edge) return std::nullopt;
  const Uvh &a = edge->from, &b = edge->to;
  const glm::dvec2 downhill{-std::cos(f.rim_angle), -std::sin(f.rim_angle)};
  const double reach_a = extent(a.h, end, far_height), reach_b = extent(b.h, end, far_height);
  const glm::dvec2 along = b.uv - a.uv;
  const double length = glm::length(along);
  const glm::dvec2 e =
      length > 1e-12 * options_.dilation ? along / length : glm::dvec2(-downhill.y, downhill.x);
  glm::dvec2 out{-e.y, e.x};
  if (glm::dot(out, downhill) < 0.0) out = -out;
  const double da = dilation(a.uv), db = dilation(b.uv);
  const double top = std::max(a.h, b.h), bottom = std::min({a.h, b.h, options_.far_height});
  const Uvh& lower = a.h < b.h ? a : b;
  const auto on_plane = [&](const glm::dvec2& uv) {
    return Uvh{uv, std::clamp(lower.h - glm::dot(uv - lower.uv, downhill), bottom, top)};
  };
  return Facet{{on_plane(a.uv - da * e - da * out), on_plane(b.uv + db * e - db * out),
                on_plane(b.uv + reach_b * downhill + db * e + db * out),
                on_plane(a.uv + reach_a * downhill - da * e + da * out)},
               a.h,
               b.h};
}

std::optional<EntryFootprints::Cone> EntryFootprints::cone(const ConeSector& cone, double end,
                                                           double far_height) const {
  const glm::dvec4 p = space_.homogeneous(mesh_.position(cone.vertex));
  if (!(p.w >= LightSpace::kNearWeight)) return std::nullopt;
  const Uvh apex = divided(p);
  return Cone{apex, extent(apex.h, end, far_height) + dilation(apex.uv)};
}

std::optional<std::array<Uvh, 3>> EntryFootprints::gap(const GapFace& gap) const {
  const IndexedTriangle& t = mesh_.triangles()[index(gap.face)];
  std::array<Uvh, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec4 p = space_.homogeneous(mesh_.positions()[t[k]]);
    if (!(p.w >= LightSpace::kNearWeight)) return std::nullopt;
    corners[k] = divided(p);
  }
  grow(corners);
  return corners;
}

std::vector<Uvh> EntryFootprints::about_window(const std::array<Uvh, 3>& corners) const {
  const UvBounds bounds = uv_bounds_of(corners);
  const glm::dvec2 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  if (options_.is_hemicube || std::max(farthest.x, farthest.y) <= kFarOutside)
    return {corners.begin(), corners.end()};
  std::vector<glm::dvec4> polygon;
  for (const Uvh& c : corners) polygon.emplace_back(c.uv, c.h, 1.0);
  polygon = clipped_to_window(std::move(polygon), 2.0 * options_.half_window);
  std::vector<Uvh> out;
  for (std::size_t k = 2; k < polygon.size(); ++k)
    for (const std::size_t i : {std::size_t{0}, k - 1, k}) out.push_back(divided(polygon[i]));
  return out;
}

/// Moves a triangle's sides outward by the dilation; the points of slivers by at most kLongestMiter times as
/// much.
void EntryFootprints::grow(std::array<Uvh, 3>& corners) const {
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
  return options_.dilation * (options_.is_hemicube ? 1.0 + glm::length(uv) : 1.0);
}

/// How far in (u, v) the boundary extends from a point at the height h before it meets a surface or the
/// lowest receiver.
double EntryFootprints::extent(double h, double end, double far_height) const {
  const double far = std::max(options_.far_height, far_height);
  return std::max(0.0, h - std::max(far, end - kMargin * (h - end)));
}

std::vector<std::uint8_t> count_facet_probes(const EntryFootprints& footprints, const Supports& supports,
                                             const std::vector<GapFace>& gaps,
                                             const ReceiverGrid& receivers) {
  std::vector<std::uint8_t> probes(supports.facets.size());
  tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t i) {
    const auto f = footprints.facet(static_cast<std::uint32_t>(i), kUnlimited, 0.0);
    if (!f) return;
    const double least = receivers.least_height(supports.facets[i].kind, uv_bounds_of(f->corners));
    const double length = glm::distance(f->corners[0].uv, f->corners[1].uv);
    if (least < std::max(f->from_height, f->to_height)) probes[i] = length < footprints.narrow() ? 1 : 3;
  });
  for (const GapFace& gap : gaps) {  // drawn where its facet is in sight
    const auto g = footprints.gap(gap);
    if (!g || probes[gap.facet] > 0) continue;
    const double highest = std::max({(*g)[0].h, (*g)[1].h, (*g)[2].h});
    if (receivers.least_height(SupportKind::kUmbra, uv_bounds_of(*g)) < highest) probes[gap.facet] = 1;
  }
  return probes;
}

std::vector<std::uint8_t> count_cone_probes(const EntryFootprints& footprints, const Supports& supports,
                                            const ReceiverGrid& receivers) {
  std::vector<std::uint8_t> probes(supports.cones.size());
  tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t i) {
    const ConeSector& sector = supports.cones[i];
    const auto c = footprints.cone(sector, kUnlimited, 0.0);
    if (c && receivers.least_height(sector.kind, uv_bounds_of(*c)) < c->apex.h)
      probes[i] = (sector.to_angle - sector.from_angle) * c->radius < footprints.narrow() ? 1 : 3;
  });
  return probes;
}

}  // namespace penumbra::detail
