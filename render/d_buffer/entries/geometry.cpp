#include "render/d_buffer/entries/geometry.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

namespace penumbra::detail {
namespace {

/// Stands for "as far as the lowest receiver".
constexpr double kEverywhere = -std::numeric_limits<double>::infinity();

/// Part of one caster's boundary. Several may run at once, each into its own geometry.
class Appender {
 public:
  /// `first` is the number of the caster's first facet.
  Appender(const EntrySource& source, std::uint32_t first, EntryGeometry& out)
      : from_(source), out_(out), first_(first) {}

  void add_facets(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      add_record(from_.supports.facets[i]);
      if (!is_hidden(from_.reach.facets[i])) add_facet(static_cast<std::uint32_t>(i));
    }
  }
  void add_cones(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (!is_hidden(from_.reach.cones[i]) && from_.supports.cones[i].from_facet != kNoFacet)
        add_cone(from_.supports.cones[i], from_.reach.cones[i]);
  }
  void add_gaps(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (!is_hidden(from_.reach.facets[from_.gaps[i].facet])) add_gap(from_.gaps[i]);
  }

 private:
  void add_record(const SupportFacet& f) {
    const EntryFootprints& shape = from_.footprints;
    const auto& facets = from_.supports.facets;
    const VertexId a = shape.begin_of(f), b = shape.end_of(f);
    const auto edge = shape.segment(a, b);
    if (!edge) return out_.records.insert(out_.records.end(), 4, glm::vec4(0.0f)), void();
    const auto point = [](const Uvh& p, std::uint32_t link) {
      return glm::vec4(glm::vec2(p.uv), static_cast<float>(p.h), static_cast<float>(link));
    };
    // The neighbor's far end, where it goes on from this edge's own end.
    const auto beyond = [&](bool has_end, const Uvh& end, VertexId at, std::uint32_t facet, bool back) {
      if (!has_end || facet == kNoFacet) return point(end, 0);
      const auto next = shape.segment(at, back ? shape.begin_of(facets[facet]) : shape.end_of(facets[facet]));
      return next && next->has_from ? point(next->to, first_ + facet + 1) : point(end, 0);
    };
    out_.records.push_back(beyond(edge->has_from, edge->from, a, f.previous, true));
    out_.records.push_back(point(edge->from, 0));
    out_.records.push_back(point(edge->to, 0));
    out_.records.push_back(beyond(edge->has_to, edge->to, b, f.next, false));
  }

  /// Least h that entries of this kind and bounds are read at; none where all of it is higher than `highest`.
  std::optional<double> least_height(SupportKind kind, const UvBounds& bounds, double highest) const {
    const double least = from_.receivers.least_height(kind, bounds);
    return least < highest ? std::optional(least) : std::nullopt;
  }

  void add_facet(std::uint32_t i) {
    const SupportKind kind = from_.supports.facets[i].kind;
    const double end = from_.reach.facets[i];
    auto f = from_.footprints.facet(i, end, kEverywhere);
    for (int pass = 0; pass < 2; ++pass) {  // once cut short, fewer receivers are in its bounds
      if (!f) return;
      const auto least = least_height(kind, uv_bounds_of(f->corners), std::max(f->from_height, f->to_height));
      if (!least) return;
      if (pass == 0) f = from_.footprints.facet(i, end, *least);
    }
    for (std::size_t k : {0, 1, 2, 0, 2, 3})
      push(triangles_of(kind), f->corners[k], first_ + i, k == 0 || k == 3 ? f->from_height : f->to_height);
  }

  /// The sector of the cone, as a fan circumscribed to it.
  void add_cone(const ConeSector& sector, double end) {
    const auto whole = from_.footprints.cone(sector, end, kEverywhere);
    if (!whole) return;
    const auto least = least_height(sector.kind, uv_bounds_of(*whole), whole->apex.h);
    if (!least) return;
    const EntryFootprints::Cone cone = *from_.footprints.cone(sector, end, *least);
    const double angle = sector.to_angle - sector.from_angle;
    // A chord of half angle h, pushed out to touch the circle, overshoots by 1/cos h - 1: half a texel is
    // allowed.
    const double allowed = std::max(1e-3, 0.5 * from_.footprints.dilation(cone.apex.uv) / cone.radius);
    const double half = std::acos(1.0 / (1.0 + allowed));
    const int segments = std::max(1, static_cast<int>(std::ceil(angle / (2.0 * half))));
    const double step = angle / segments;
    const double far_h = cone.apex.h - cone.radius;
    const auto at = [&](double at_angle, double stretch) {
      return Uvh{cone.apex.uv - cone.radius * stretch * glm::dvec2(std::cos(at_angle), std::sin(at_angle)),
                 far_h};
    };
    const double stretch = 1.0 / std::cos(std::min(0.5 * step, 1.0));
    if (segments == 1 && from_.supports.facets[sector.from_facet].next == sector.to_facet) {
      // Either facet knows of the other: no need to tell their halves apart.
      for (const Uvh& corner : {cone.apex, at(sector.from_angle, stretch), at(sector.to_angle, stretch)})
        push(triangles_of(sector.kind), corner, first_ + sector.from_facet, cone.apex.h);
      return;
    }
    Uvh last = at(sector.from_angle, 1.0);
    for (int k = 0; k <= segments; ++k) {
      const Uvh next =
          k < segments ? at(sector.from_angle + (k + 0.5) * step, stretch) : at(sector.to_angle, 1.0);
      const std::uint32_t facet = 2 * k < segments ? sector.from_facet : sector.to_facet;
      for (const Uvh& corner : {cone.apex, last, next})
        push(triangles_of(sector.kind), corner, first_ + facet, cone.apex.h);
      last = next;
    }
  }

  void add_gap(const GapFace& gap) {
    const auto corners = from_.footprints.gap(gap);
    if (!corners) return;
    const double highest = std::max({(*corners)[0].h, (*corners)[1].h, (*corners)[2].h});
    if (!least_height(SupportKind::kUmbra, uv_bounds_of(*corners), highest)) return;
    for (const Uvh& c : from_.footprints.about_window(*corners)) push(out_.umbra, c, first_ + gap.facet, c.h);
  }

  std::vector<EntryVertex>& triangles_of(SupportKind kind) {
    return kind == SupportKind::kPenumbra ? out_.penumbra : out_.umbra;
  }

  static void push(std::vector<EntryVertex>& triangles, const Uvh& p, std::uint32_t facet,
                   double edge_height) {
    const double most = std::max({1.0, std::abs(p.uv.x), std::abs(p.uv.y), std::abs(p.h)});
    triangles.push_back(
        {glm::vec4(glm::dvec4(p.uv, p.h, 1.0) / most), facet, static_cast<float>(edge_height)});
  }

  const EntrySource& from_;
  EntryGeometry& out_;
  std::uint32_t first_;
};

using EntryTriangle = std::array<EntryVertex, 3>;

bool comes_before(const EntryTriangle& one, const EntryTriangle& two) {
  const auto height = [](const EntryVertex& v) { return v.place.z / v.place.w; };
  const auto highest = [&](const EntryTriangle& t) {
    return std::max({height(t[0]), height(t[1]), height(t[2])});
  };
  const auto numbers = [](const EntryVertex& v) {
    return std::tie(v.place.x, v.place.y, v.place.z, v.place.w, v.edge_height);
  };
  if (highest(one) != highest(two)) return highest(one) > highest(two);
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

void append_entry_geometry(const EntrySource& source, EntryGeometry& out) {
  constexpr std::size_t kPart = 512;
  const auto parts_of = [](std::size_t count) { return (count + kPart - 1) / kPart; };
  const std::size_t facets = source.supports.facets.size(), cones = source.supports.cones.size();
  const std::size_t facet_parts = parts_of(facets), cone_parts = parts_of(cones);
  const auto first = static_cast<std::uint32_t>(out.records.size() / 4);
  std::vector<EntryGeometry> parts(facet_parts + cone_parts + parts_of(source.gaps.size()));
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    Appender part(source, first, parts[i]);
    const auto run = [&](auto add, std::size_t number, std::size_t count) {
      (part.*add)(number * kPart, std::min(count, (number + 1) * kPart));
    };
    if (i < facet_parts)
      run(&Appender::add_facets, i, facets);
    else if (i < facet_parts + cone_parts)
      run(&Appender::add_cones, i - facet_parts, cones);
    else
      run(&Appender::add_gaps, i - facet_parts - cone_parts, source.gaps.size());
  });
  for (const EntryGeometry& part : parts) {
    out.records.insert(out.records.end(), part.records.begin(), part.records.end());
    out.penumbra.insert(out.penumbra.end(), part.penumbra.begin(), part.penumbra.end());
    out.umbra.insert(out.umbra.end(), part.umbra.begin(), part.umbra.end());
  }
}

}  // namespace penumbra::detail
