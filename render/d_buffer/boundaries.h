// D-buffer step 4: the boundaries of the casters' shadows.
//
// In: casters, light, who will read the D-buffer. Out: for every caster its facets, cone sectors and gap
// faces (volumes/supports.h), how far each reaches, and all of it as triangles to draw.
//
//   outline    classes → silhouettes → facets, gap faces        by the light alone, kept while it stays
//   boundary   reach of facets → cone sectors → their reach      by what receivers will read
//   geometry   triangles and records                             entries/geometry.h
//
// "Umbra and penumbra volumes" (2004), sections 2 and 3. The paper draws every facet to the end of the scene;
// here only those count that light really grazes, as far as it goes on.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/support/counts.h"
#include "penumbra/volumes/supports.h"
#include "render/d_buffer/entries/facet_reach.h"
#include "render/d_buffer/entries/geometry.h"
#include "render/d_buffer/view/casters.h"
#include "render/d_buffer/view/view.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// Where the shadow of one caster may be bounded, by the light alone. Empty for a caster that cannot occlude.
struct Outline {
  Classification classes;
  Silhouettes silhouettes;
  /// Facets; not linked yet, and no cones.
  Supports supports;
  std::vector<GapFace> gaps;
};

/// The outlines of all casters for one light.
class Outlines {
 public:
  /// One a caster. Adds the stages classify, silhouettes and supports to the clock; does nothing if light and
  /// casters are those of the last call. Cost O(faces + band).
  void find(std::span<const DBufferCaster> casters, const CircularLight& light, StageClock& clock);
  /// The next call of `find` finds everything anew: a caster can occlude that could not, or timing needs it.
  void forget() { light_.reset(); }
  std::span<const Outline> all() const { return outlines_; }

 private:
  std::vector<Outline> outlines_;
  /// The light that they are for.
  std::optional<CircularLight> light_;
};

/// What of an outline receivers can read.
struct Boundary {
  const Outline* outline;
  /// Facets as in the outline, linked where light grazes them, and cone sectors.
  Supports supports;
  FacetReach reach;
};

/// What one frame's boundaries are found from.
struct BoundarySource {
  std::span<const DBufferCaster> casters;
  const CircularLight& light;
  const DBufferView& view;
  /// Who will read what.
  const ReceiverGrid& receivers;
  const RayScene& rays;
};

/// One boundary an outline; refers to the outlines. Adds the stages reach and corners to the clock.
/// Cost O((facets + cone sectors) · log faces).
std::vector<Boundary> find_boundaries(const BoundarySource& source, std::span<const Outline> outlines,
                                      StageClock& clock);

/// Triangles and records of all boundaries, in an order that does not depend on how meshes list their faces.
/// Empty where the view has no targets. Cost O(n log n), n the number of triangles.
EntryGeometry find_geometry(const BoundarySource& source, std::span<const Boundary> boundaries);

/// Faces, edges, facets and cone sectors of all casters.
Counts count_boundaries(std::span<const Boundary> boundaries);

}  // namespace penumbra::detail
