// The D-buffer: what the light's center sees of penumbra boundaries, and the visibility shader that reads it.
//
// In: caster meshes (uploaded once), surface points (uploaded once per camera), a light. Out: visibility per
// pixel. "Umbra and penumbra volumes" (2004), sections 3 and 4. There a texel stores the distances |cxo|,
// |cxuv|, |cxpv| and |cxs|; here it stores the occluder's face and depth and *which edge* bounds the penumbra
// on that line of sight, so that the chord it leaves of the disk is exact for the receiver (no eq. 2 and 3;
// the distances are an option). The edges next to it are known: the boundary is followed as far as it lies in
// the disk. Facets are drawn in (1/z)-linear depth and dilated by a texel, so that no texel that touches the
// penumbra is empty (towards the border of a hemicube's side by less than one).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "penumbra/render/support/counts.h"
#include "penumbra/render/support/texture_picture.h"
#include "render/gl/context.h"
#include "render/rays/ray_scene.h"
#include "render/support/named_value.h"

namespace penumbra {

enum class DBufferContents {
  kEdge,       ///< which edge bounds the penumbra: the chord is exact for every receiver
  kDistances,  ///< the 2004 paper's |cxuv|, |cxpv| and |cxs|, with eq. 2 and 3 corrected
};
enum class VisibilityCurve {
  kExact,       ///< the disk's area beyond the chord; with kEdge, beyond the boundary of which it is part
  kSmoothstep,  ///< 3t² - 2t³ (the paper's eq. 4), t = (1 + δ)/2; off by up to 0.039
  kSquareRoot,  ///< √t (the paper's section 6.2, for small occluders)
};
enum class CenterTest {
  kRay,    ///< one ray a pixel: right for every receiver
  kDepth,  ///< the depth of the first surface in the texel, with a bias in the height above the receiver's
           ///< plane
};
enum class EntryCheck {
  kRays,  ///< sixteen rays a pixel where neighbours on one surface contradict each other (a step of more than
          ///< .07 that no slope explains), where an entry contradicts what is known of the light's center,
          ///< and at even distances; they replace what entries say by more than their noise otherwise.
          ///< Against leaks, penumbrae of edges that something else hides, seams between a texel's entries,
          ///< and surfaces on which all entries are wrong.
  kNone,
};
enum class Conflict { kNearest, kFurthest };  ///< which of several entries on a line of sight a texel keeps

/// The words for these.
std::span<const NamedValue<DBufferContents>> d_buffer_contents();
std::span<const NamedValue<VisibilityCurve>> visibility_curves();
std::span<const NamedValue<Conflict>> conflicts();
std::span<const NamedValue<CenterTest>> center_tests();
std::span<const NamedValue<EntryCheck>> entry_checks();

struct DBufferOptions {
  int size = 0;  ///< texels a side of each target, 16 to 8192; 0: d_buffer_size_for the image
  DBufferContents contents = DBufferContents::kEdge;
  int entries = 1;  ///< entries kept per texel and kind of boundary, 1 or 2 (2: kEdge and kNearest only)
  VisibilityCurve curve = VisibilityCurve::kExact;
  Conflict conflict = Conflict::kNearest;
  CenterTest center = CenterTest::kRay;  ///< how it is told whether the light's center is hidden
  EntryCheck check =
      EntryCheck::kRays;  ///< what is done about entries that contradict each other; with kEdge, kExact, kRay
};

/// Texels a side that are about as many as the image's pixels: the root of their number, up to the next
/// multiple of 64, 512 to 4096. More shows in few scenes (README), and rasterisation grows with the area.
int d_buffer_size_for(int width, int height);

struct DBufferFrame {
  std::vector<float> visibility;  ///< one per pixel of the surface buffer; 1 where nothing is seen
  std::vector<StageTime> stages;
  Counts counts;  ///< faces by class, edges, facets, triangles drawn, targets, bytes
};

class DBuffer {
 public:
  /// Uploads the casters. `context`, `scene` and `rays` must outlive the D-buffer; the context is made
  /// current by each call.
  DBuffer(gl::Context& context, const Scene& scene, const RayScene& rays);
  ~DBuffer();
  /// The receivers, once per camera; copied. Cost O(pixels).
  void set_surface(const Receivers& surface);
  /// All that depends on the light is rebuilt: classes, silhouettes, facets, buffers, visibility; the first
  /// three are kept while the light stays as it is. Throws UsageError for a size or entries outside their
  /// range and before set_surface, SystemError where OpenGL fails, Cancelled. Cost O(faces + band + texels +
  /// pixels), and one or two rays a pixel with CenterTest::kRay, and sixteen where entries contradict each
  /// other with EntryCheck::kRays.
  DBufferFrame render(const DiskLight& light, const DBufferOptions& options, const Progress& progress = {});
  /// The next frame finds everything anew, though its light be that of the last: for timing.
  void forget_light();
  /// What the last frame left in the textures of the first target: the first surface, penumbra entries, umbra
  /// entries before and behind the last surface; none that are empty. Each by number, one grey a number, and
  /// by depth, what is nearer to the light brighter.
  std::vector<TexturePicture> textures() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
