#include "render/d_buffer/boundaries.h"

#include <algorithm>
#include <utility>

#include "penumbra/volumes/volumes.h"

namespace penumbra::detail {
namespace {

EntryFootprints footprints_of(const DBufferCaster& caster, const DBufferView& view,
                              const Boundary& boundary) {
  return {*caster.mesh, view.space, boundary.supports, view.footprint};
}

/// Times of the same name add up.
void add_to(StageTimes& sums, const StageTime& time) {
  const auto same = std::ranges::find(sums, time.name, &StageTime::name);
  if (same == sums.end())
    sums.push_back(time);
  else
    same->milliseconds += time.milliseconds;
}

}  // namespace

void Outlines::find(std::span<const DBufferCaster> casters, const CircularLight& light, StageClock& clock) {
  if (light_ == light) return;
  light_.reset();
  outlines_.assign(casters.size(), {});
  StageTimes times;
  for (std::size_t i = 0; i < casters.size(); ++i) {
    if (casters[i].cannot_occlude) continue;
    ShadowVolumes found = build_shadow_volumes(*casters[i].mesh, light, {.penumbra = false, .umbra = false});
    outlines_[i].classes = std::move(found.classes);
    outlines_[i].silhouettes = std::move(found.silhouettes);
    for (const StageTime& time : found.stages) add_to(times, time);
  }
  for (const StageTime& time : times) clock.add(time);
  for (std::size_t i = 0; i < casters.size(); ++i) {
    if (casters[i].cannot_occlude) continue;
    const TriangleMesh& mesh = *casters[i].mesh;
    Outline& outline = outlines_[i];
    outline.supports.facets = find_support_facets(mesh, light, outline.silhouettes);
    outline.gaps = find_gap_faces(mesh, light, outline.classes, outline.supports);
  }
  clock.finish("supports");
  light_ = light;
}

/// Most facets of a fine mesh are hidden, so cone sectors are found only where one ends that is not.
std::vector<Boundary> find_boundaries(const BoundarySource& source, std::span<const Outline> outlines,
                                      StageClock& clock) {
  std::vector<Boundary> boundaries;
  for (const Outline& o : outlines) boundaries.push_back({&o, o.supports, {}});
  const auto stage = [&](const char* name, const auto& body) {
    for (std::size_t i = 0; i < source.casters.size(); ++i)
      if (!source.casters[i].cannot_occlude) body(source.casters[i], boundaries[i]);
    clock.finish(name);
  };
  const auto probes_of = [&](const DBufferCaster& c) {
    return ProbeSource{static_cast<std::int32_t>(c.object), source.light, source.view.space, source.rays};
  };
  stage("reach", [&](const DBufferCaster& c, Boundary& b) {
    const auto probes =
        count_facet_probes(footprints_of(c, source.view, b), b.supports, b.outline->gaps, source.receivers);
    find_facet_reach(*c.mesh, b.supports, probes, probes_of(c), b.reach);
  });
  stage("corners", [&](const DBufferCaster& c, Boundary& b) {
    std::vector<char> is_grazed(b.reach.facets.size());
    for (std::size_t i = 0; i < is_grazed.size(); ++i) is_grazed[i] = !is_hidden(b.reach.facets[i]);
    link_support_facets(*c.mesh, c.rings, source.light, is_grazed, b.supports);
    const auto probes = count_cone_probes(footprints_of(c, source.view, b), b.supports, source.receivers);
    find_cone_reach(*c.mesh, b.supports, probes, probes_of(c), b.reach);
  });
  return boundaries;
}

EntryGeometry find_geometry(const BoundarySource& source, std::span<const Boundary> boundaries) {
  EntryGeometry geometry;
  if (source.view.targets.empty()) return geometry;
  for (std::size_t i = 0; i < source.casters.size(); ++i) {
    if (source.casters[i].cannot_occlude) continue;
    const Boundary& b = boundaries[i];
    const EntryFootprints footprints = footprints_of(source.casters[i], source.view, b);
    append_entry_geometry({footprints, b.supports, b.outline->gaps, b.reach, source.receivers}, geometry);
  }
  sort_by_geometry(geometry);
  return geometry;
}

Counts count_boundaries(std::span<const Boundary> boundaries) {
  std::size_t faces = 0, mixed = 0, umbra = 0, penumbra = 0, band = 0, facets = 0, cones = 0;
  for (const Boundary& b : boundaries) {
    faces += b.outline->classes.faces.size();
    mixed += b.outline->classes.mixed;
    umbra += b.outline->silhouettes.umbra.size();
    penumbra += b.outline->silhouettes.penumbra.size();
    band += b.outline->silhouettes.band.size();
    facets += b.supports.facets.size();
    cones += b.supports.cones.size();
  }
  return {{"faces", faces},     {"mixed_faces", mixed}, {"umbra_edges", umbra}, {"penumbra_edges", penumbra},
          {"band_edges", band}, {"facets", facets},     {"cone_sectors", cones}};
}

}  // namespace penumbra::detail
