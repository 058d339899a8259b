// The D-buffer: what the light's center sees of shadow boundaries, and a visibility shader that reads it.
//
// In: the scene's casters (uploaded once), surface points (uploaded once per camera), a disk light. Out:
// visibility V of every surface point. "Umbra and penumbra volumes" (2004), sections 3 and 4. The steps of a
// frame, in order, with the stage of --stats that they are timed as:
//
//   1 center       center_rays.h            a ray from every surface point to the light's center
//   2 receivers    receivers/occluding_casters.h
//                                           which casters cannot occlude: they take no part
//   3 receivers    view/, entries/receiver_grid.h
//                                           the light's space and its window, perspectives from the light's
//                                           center; which texels will be read
//   4 classify, silhouettes, supports, reach, corners, facets
//                  boundaries.h, entries/   facets, cone sectors and gap faces of the boundaries, as
//                                           triangles
//   5 occluders    fill_passes.h            first and last surface, drawn while step 4 runs
//   6 entries      fill_passes.h            the triangles of step 4, drawn while entries/tiles.h chooses the
//                                           parts of the image that step 7 visits
//   7 visibility   visibility_pass.h        the shader: texel → entry → boundary on the disk → V
//   8 visibility   resampler.h              pixels whose entries contradict each other are sampled by rays
//
// What a texel keeps. The paper's texel has the distances |cxo|, |cxuv|, |cxpv| and |cxs|. Here it has the
// occluder's face and depth and *which edge* bounds the penumbra on that line of sight. So the chord that the
// edge cuts off the disk is exact for every receiver, and eq. 2 and 3 are not needed (the paper prints eq. 2
// inverted and the branches of eq. 3 swapped); the paper's own contents, corrected, are an option. Neighbors
// of an edge are known too: the shader follows the boundary as far as it lies in the disk.
//
// Everything is drawn and looked up in a space in which every light is a distant one (view/light_space.h),
// relative to the part of it that the image's receivers and the casters' penumbras have in common. It is made
// in double for each frame, and only then rounded to float: neither a light that is far away nor a floor that
// goes on to the horizon costs digits.
//
// Other departures. Depths are heights in that space, which are linear on the screen (the paper interpolates
// distances and accepts the error). Triangles are dilated by a texel, so that no texel that touches a
// penumbra is empty (towards the border of a hemicube's side by less than one). Step 1 replaces the paper's
// shadow map, and steps 2, 3 and 8 are not in the paper.
#pragma once

#include <memory>
#include <span>
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

/// What a texel keeps of a boundary.
enum class DBufferContents {
  kEdge,       ///< which edge it starts from: the chord is exact for every receiver
  kDistances,  ///< the 2004 paper's |cxuv|, |cxpv| and |cxs|, with eq. 2 and 3 corrected
};
/// Visibility as a function of the chord.
enum class VisibilityCurve {
  kExact,  ///< the disk's area beyond the chord; with kEdge beyond the boundary that the chord is part of
  kSmoothstep,  ///< 3t² - 2t³ (the paper's eq. 4), t = (1 + δ)/2; off by up to 0.039
  kSquareRoot,  ///< √t (the paper's section 6.2, for small occluders)
};
/// How it is decided whether a receiver sees the light's center.
enum class CenterTest {
  kRay,    ///< one ray a pixel: right for every receiver
  kDepth,  ///< the depth of the first surface in the texel, as the paper; biased along the receiver's normal
};
/// What is done about entries that contradict each other. Only with kEdge, kExact and kRay; else nothing is
/// done.
enum class EntryCheck {
  kRays,  ///< some pixels are sampled by sixteen rays, see resampler.h
  kNone,
};
/// Which of several entries on a line of sight a texel keeps.
enum class Conflict { kNearest, kFurthest };

/// The words for these, as in the options of the command line and in --stats.
std::span<const NamedValue<DBufferContents>> d_buffer_contents();
std::span<const NamedValue<VisibilityCurve>> visibility_curves();
std::span<const NamedValue<Conflict>> conflicts();
std::span<const NamedValue<CenterTest>> center_tests();
std::span<const NamedValue<EntryCheck>> entry_checks();

struct DBufferOptions {
  /// Texels a side of each target, 16 to 8192; 0: d_buffer_size_for the image.
  int size = 0;
  DBufferContents contents = DBufferContents::kEdge;
  /// Entries kept per texel and kind of boundary, 1 or 2. 2 needs kEdge and kNearest.
  int entries = 1;
  VisibilityCurve curve = VisibilityCurve::kExact;
  Conflict conflict = Conflict::kNearest;
  CenterTest center = CenterTest::kRay;
  EntryCheck check = EntryCheck::kRays;
};

/// Texels a side that are about as many as the image's pixels: the root of their number, up to the next
/// multiple of 64, 512 to 4096. More shows in few scenes, and the time to draw grows with the area.
int d_buffer_size_for(int width, int height);

struct DBufferFrame {
  /// One a receiver; 1 where nothing is seen.
  std::vector<float> visibility;
  std::vector<StageTime> stages;
  /// Faces by class, edges, facets, triangles drawn, targets, pixels sampled by rays, texels a side, bytes.
  Counts counts;
};

/// A D-buffer kept between frames: textures, programs and what depends on casters or camera alone are made
/// once.
class DBuffer {
 public:
  /// Uploads the casters. `context`, `scene` and `rays` must outlive the D-buffer, and the casters stay as
  /// they are; the context is made current by each call. Cost O(vertices + faces). Throws SystemError where
  /// OpenGL fails.
  DBuffer(gl::Context& context, const Scene& scene, const RayScene& rays);
  ~DBuffer();
  /// The receivers, pixels of a picture with normals: once per camera, before `render`. They are copied. Cost
  /// O(pixels). Throws SystemError.
  void set_surface(const Receivers& surface);
  /// Visibility of the receivers under `light`. Outlines of casters are kept while the light stays,
  /// everything else is made anew; a frame never depends on the frames before it. Throws UsageError for a
  /// size or entries outside their range and before set_surface, SystemError where OpenGL fails, Cancelled.
  /// Cost O(faces + band + texels + pixels), one ray a pixel with CenterTest::kRay, and sixteen for each
  /// pixel that is resampled.
  DBufferFrame render(const CircularLight& light, const DBufferOptions& options,
                      const Progress& progress = {});
  /// The next frame finds outlines anew even if the light stays: for timing.
  void forget_light();
  /// What the last frame left in the textures of the first target: the first surface, penumbra entries, umbra
  /// entries before and behind the last surface; none that are empty. Each by number, one gray a number, and
  /// by depth, what is nearer to the light brighter.
  std::vector<TexturePicture> textures() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
