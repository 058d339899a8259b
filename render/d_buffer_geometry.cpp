#include "render/d_buffer_geometry.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace penumbra::detail {
namespace {

/// A point in (u, v, w).
struct Uvw {
  glm::dvec2 uv;
  double w;
};

Uvw project(const Vec3& p) {
  return {glm::dvec2(p.x, p.y) / p.z, 1.0 / p.z};
}

class Appender {
 public:
  Appender(const EntrySource& source, const EntryGeometryOptions& options, EntryGeometry& out)
      : mesh_(source.mesh),
        space_(source.space),
        supports_(source.supports),
        gaps_(source.gaps),
        reach_(source.reach),
        options_(options),
        out_(out),
        first_(static_cast<std::uint32_t>(out.records.size() / 4)) {}

  void run() {
    for (std::uint32_t i = 0; i < supports_.facets.size(); ++i) {
      add_record(supports_.facets[i]);
      if (reach_.facets[i] > 0.0f) add_facet(i);
    }
    for (std::size_t i = 0; i < supports_.cones.size(); ++i)
      if (reach_.cones[i] > 0.0f && supports_.cones[i].from_facet != kNoFacet)
        add_cone(supports_.cones[i], reach_.cones[i]);
    for (const GapFace& gap : gaps_)
      if (reach_.facets[gap.facet] > 0.0f) add_gap(gap);
  }

 private:
  Vec3 local(VertexId v) const { return space_.to_light(mesh_.position(v)); }
  VertexId begin_of(const SupportFacet& f) const {
    const Edge& e = mesh_.edges()[index(f.edge)];
    return f.flipped ? e.to : e.from;
  }
  VertexId end_of(const SupportFacet& f) const {
    const Edge& e = mesh_.edges()[index(f.edge)];
    return f.flipped ? e.from : e.to;
  }

  void add_record(const SupportFacet& f) {
    const auto point = [&](VertexId v, std::uint32_t facet) {
      const std::uint32_t link = facet == kNoFacet ? 0 : first_ + facet + 1;
      return glm::vec4(glm::vec3(local(v)), static_cast<float>(link));
    };
    const bool before = f.previous != kNoFacet, after = f.next != kNoFacet;
    out_.records.push_back(point(before ? begin_of(supports_.facets[f.previous]) : begin_of(f), f.previous));
    out_.records.push_back(point(begin_of(f), kNoFacet));
    out_.records.push_back(point(end_of(f), kNoFacet));
    out_.records.push_back(point(after ? end_of(supports_.facets[f.next]) : end_of(f), f.next));
  }

  /// The quadrilateral from the edge along the plane w = (cos φ u + sin φ v + κ)/r, down to the farthest
  /// receiver.
  void add_facet(std::uint32_t i) {
    const SupportFacet& f = supports_.facets[i];
    Vec3 pa = local(begin_of(f)), pb = local(end_of(f));
    if (!cut(pa, pb)) return;
    const Uvw a = project(pa), b = project(pb);
    const glm::dvec2 downhill{-std::cos(f.rim_angle), -std::sin(f.rim_angle)};
    const double reach_a = extent(a.w, reach_.facets[i]), reach_b = extent(b.w, reach_.facets[i]);
    const glm::dvec2 along = b.uv - a.uv;
    const double length = glm::length(along);
    glm::dvec2 e = length > 1e-12 ? along / length : glm::dvec2(-downhill.y, downhill.x);
    glm::dvec2 out{-e.y, e.x};
    if (glm::dot(out, downhill) < 0.0) out = -out;
    const double da = dilation(a.uv), db = dilation(b.uv);
    const double top = std::max(a.w, b.w);
    const auto on_plane = [&](const glm::dvec2& uv) {
      return Uvw{uv, std::clamp(a.w - glm::dot(uv - a.uv, downhill) / space_.radius, 0.0, top)};
    };
    const Uvw corners[4] = {on_plane(a.uv - da * e - da * out), on_plane(b.uv + db * e - db * out),
                            on_plane(b.uv + reach_b * downhill + db * e + db * out),
                            on_plane(a.uv + reach_a * downhill - da * e + da * out)};
    auto& triangles = f.kind == SupportKind::kPenumbra ? out_.penumbra : out_.umbra;
    for (int k : {0, 1, 2, 0, 2, 3}) push(triangles, corners[k], first_ + i, k == 0 || k == 3 ? a.w : b.w);
  }

  /// The sector of the cone, as a fan circumscribed to it.
  void add_cone(const ConeSector& cone, float cone_reach) {
    const Vec3 p = local(cone.vertex);
    if (p.z <= options_.near_depth) return;
    const Uvw apex = project(p);
    const double reach = extent(apex.w, cone_reach) + dilation(apex.uv);
    const double sector = cone.to_angle - cone.from_angle;
    // A chord of half angle h, pushed out to touch the circle, overshoots by 1/cos h - 1: half a texel is
    // allowed.
    const double allowed = std::max(1e-3, 0.5 * dilation(apex.uv) / reach);
    const double half = std::acos(1.0 / (1.0 + allowed));
    const int segments = std::max(1, static_cast<int>(std::ceil(sector / (2.0 * half))));
    const double step = sector / segments;
    const double far_w = std::max(0.0, apex.w - reach / space_.radius);
    const auto at = [&](double angle, double stretch) {
      return Uvw{apex.uv - reach * stretch * glm::dvec2(std::cos(angle), std::sin(angle)), far_w};
    };
    auto& triangles = cone.kind == SupportKind::kPenumbra ? out_.penumbra : out_.umbra;
    const double stretch = 1.0 / std::cos(std::min(0.5 * step, 1.0));
    Uvw last = at(cone.from_angle, 1.0);
    for (int k = 0; k <= segments; ++k) {
      const Uvw next =
          k < segments ? at(cone.from_angle + (k + 0.5) * step, stretch) : at(cone.to_angle, 1.0);
      const std::uint32_t facet = 2 * k < segments ? cone.from_facet : cone.to_facet;
      for (const Uvw& corner : {apex, last, next}) push(triangles, corner, first_ + facet, apex.w);
      last = next;
    }
  }

  /// A face as it is; those that reach the near depth are left to the facets.
  void add_gap(const GapFace& gap) {
    const IndexedTriangle& t = mesh_.triangles()[index(gap.face)];
    Uvw corners[3];
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = local(VertexId{t[static_cast<std::size_t>(k)]});
      if (p.z <= options_.near_depth) return;
      corners[k] = project(p);
    }
    grow(corners);
    for (const Uvw& c : corners) push(out_.umbra, c, first_ + gap.facet, c.w);
  }

  /// Moves a triangle's sides outward by the dilation; the points of slivers by at most three times as much.
  void grow(Uvw (&corners)[3]) const {
    glm::dvec2 out[3];  // of the side from corner k to the next
    const auto next = [](int k) { return (k + 1) % 3; };
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 side = corners[next(k)].uv - corners[k].uv;
      const double length = glm::length(side);
      if (!(length > 0.0)) return;
      out[k] = glm::dvec2(side.y, -side.x) / length;
    }
    const glm::dvec2 middle = (corners[0].uv + corners[1].uv + corners[2].uv) / 3.0;
    const double turn = glm::dot(out[0], corners[0].uv - middle) < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 sum = turn * (out[k] + out[next(next(k))]);
      const double least = 2.0 / 3.0;  // of |sum|: where the miter is three times the dilation
      const double size = std::max(glm::length(sum), 1e-9);
      corners[k].uv += dilation(corners[k].uv) * (size > least ? 2.0 / (size * size) : 3.0 / size) * sum;
    }
  }

  /// A hemicube's texel covers more of (u, v) towards the horizon: 1 + |uv| times as much across, and more
  /// along the radius; the smaller factor is taken, since too wide a facet hides its neighbours.
  double dilation(const glm::dvec2& uv) const {
    return options_.dilation * (options_.grows_with_uv ? 1.0 + glm::length(uv) : 1.0);
  }

  /// How far in (u, v) the boundary extends from a point at 1/z = w before it meets a surface or the farthest
  /// receiver.
  double extent(double w, float reach) const {
    constexpr double kMargin = 1.05;  // the reach was probed at a few points only
    return space_.radius *
           std::max(0.0, w - std::max(options_.far_weight, w / (kMargin * static_cast<double>(reach))));
  }

  /// Cuts the segment at the near depth; false where nothing is left.
  bool cut(Vec3& a, Vec3& b) const {
    const double n = options_.near_depth;
    if (a.z < n && b.z < n) return false;
    if (a.z < n) a = b + (a - b) * ((b.z - n) / (b.z - a.z));
    if (b.z < n) b = a + (b - a) * ((a.z - n) / (a.z - b.z));
    return true;
  }

  void push(std::vector<EntryVertex>& triangles, const Uvw& p, std::uint32_t facet, double edge_weight) {
    triangles.push_back({static_cast<float>(p.uv.x), static_cast<float>(p.uv.y), static_cast<float>(p.w),
                         facet, static_cast<float>(edge_weight)});
  }

  const TriangleMesh& mesh_;
  const LightSpace& space_;
  const Supports& supports_;
  const std::vector<GapFace>& gaps_;
  const FacetReach& reach_;
  const EntryGeometryOptions& options_;
  EntryGeometry& out_;
  std::uint32_t first_;
};

using EntryTriangle = std::array<EntryVertex, 3>;

bool comes_before(const EntryTriangle& one, const EntryTriangle& two) {
  const auto nearest = [](const EntryTriangle& t) { return std::max({t[0].w, t[1].w, t[2].w}); };
  const auto numbers = [](const EntryVertex& v) { return std::tie(v.u, v.v, v.w, v.edge_weight); };
  if (nearest(one) != nearest(two)) return nearest(one) > nearest(two);
  for (std::size_t k = 0; k < 3; ++k)
    if (numbers(one[k]) != numbers(two[k])) return numbers(one[k]) < numbers(two[k]);
  return false;
}

}  // namespace

void sort_by_geometry(EntryGeometry& entries) {
  for (auto* vertices : {&entries.penumbra, &entries.umbra}) {
    std::vector<EntryTriangle> triangles(vertices->size() / 3);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      std::copy_n(vertices->begin() + static_cast<std::ptrdiff_t>(3 * i), 3, triangles[i].begin());
    tbb::parallel_sort(triangles.begin(), triangles.end(), comes_before);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      std::copy_n(triangles[i].begin(), 3, vertices->begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
}

LightSpace::LightSpace(const DiskLight& light, double scale_factor)
    : axes(light_frame(light)),
      center(light.center),
      scale(scale_factor),
      radius(light.radius * scale_factor) {}

Vec3 LightSpace::to_light(const Vec3& world) const {
  const Vec3 d = (world - center) * scale;
  return {glm::dot(d, axes.u), glm::dot(d, axes.v), glm::dot(d, axes.w)};
}

void append_entry_geometry(const EntrySource& source, const EntryGeometryOptions& options,
                           EntryGeometry& out) {
  Appender(source, options, out).run();
}

}  // namespace penumbra::detail
