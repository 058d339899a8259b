// Occlusion textures: the scene x-rayed in slices parallel to the light, prefiltered, and looked up once a
// slice and pixel.
//
// In: the scene's casters, surface points, a light: a disk, a rectangle or a distant light. Out: visibility V
// of every surface point. E. Eisemann and X. Décoret, "Plausible image based soft shadows using occlusion
// textures" (2006). The cost depends neither on the light's size nor, but for drawing them once, on the
// casters. The steps of a frame, in order, with the stage of --stats that they are timed as:
//
//   1 frustum     frustum.h     from where and in which slices the casters are seen          (section 3.4)
//   2 slices      masks.h       4 to 16 slices into 1 to 4 RGBA targets, in one pass         (section 3.4)
//   3 read_back   masks.h       texels to the processor
//   4 prefilter   mip_pyramid.h, n_buffer.h or summed_area.h                                 (section 3.2)
//   5 visibility  lookup.h      the light's image on each slice, and their combination (sections 3.1, 3.3)
//
// Departures. The window of the textures is fitted to the casters and keeps only the light's proportions (the
// paper's is the light itself): no texel is wasted, and kernels that jut out of it are clipped exactly.
// Prefilters and lookups are C++ on all cores, which without a GPU is faster than shaders. Only faces that
// look at the center of projection are drawn where that suffices (SliceFaces). The receiver's horizon is
// combined like one more slice.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "penumbra/render/support/counts.h"
#include "penumbra/render/support/texture_picture.h"
#include "render/gl/context.h"
#include "render/light/area_light.h"
#include "render/rays/ray_scene.h"
#include "render/support/named_value.h"

namespace penumbra {

/// How the mean of a box of texels is found.
enum class OcclusionFilter {
  kMipmap,      ///< trilinear; cheapest, blocky
  kNBuffer,     ///< boxes of every power of two, placed continuously; interpolated between
  kSummedArea,  ///< every box exactly
};
/// How what the slices hide is put together.
enum class OcclusionCombine {
  kProduct,  ///< slices hide independent parts of the light (the paper's eq. 5)
  kSum,      ///< disjoint parts
  kMaximum,  ///< the same part
};
/// By which boxes the light is looked up.
enum class OcclusionKernel {
  kBox,   ///< of a disk light the square of equal area; of a rectangle its own shape
  kDisk,  ///< of a disk light strips that approximate it; of a rectangle its own shape
};
/// Whether each slice is drawn into the next one too, see OcclusionOptions::thin_fix.
enum class ThinFix { kOff, kOn, kAuto };
/// Which depths are sliced.
enum class SliceRange {
  kScene,    ///< from the nearest to the farthest point of all objects
  kCasters,  ///< of the objects that cast
  kAuto,     ///< kCasters where something that does not cast begins less than one slice of the scene's range
             ///< behind the casters' far end: contact shadows need the finer slices; else kScene
};
/// What a texel of a slice holds.
enum class SliceCoverage {
  kBinary,  ///< a texel is covered or not, by its center
  kArea,    ///< eight samples a texel
};
/// Which faces are drawn.
enum class SliceFaces {
  kAll,    ///< every face, as the paper
  kFront,  ///< of closed casters wholly in front of the light only what faces the center of projection
};

/// The words for these, as in the options of the command line and in --stats.
std::span<const NamedValue<OcclusionFilter>> occlusion_filters();
std::span<const NamedValue<OcclusionCombine>> occlusion_combines();
std::span<const NamedValue<OcclusionKernel>> occlusion_kernels();
std::span<const NamedValue<ThinFix>> thin_fixes();
std::span<const NamedValue<SliceRange>> slice_ranges();
std::span<const NamedValue<SliceCoverage>> slice_coverages();
std::span<const NamedValue<SliceFaces>> slice_faces();

struct OcclusionOptions {
  /// 4, 8, 12 or 16, of equal thickness.
  int slices = 16;
  /// Texels a side: 128, 256, 512 or 1024.
  int texture_size = 512;
  OcclusionFilter filter = OcclusionFilter::kSummedArea;
  OcclusionCombine combine = OcclusionCombine::kProduct;
  OcclusionKernel kernel = OcclusionKernel::kBox;
  /// Each slice is drawn into the next one too, against light that leaks between them. kAuto: for objects
  /// that are open, or whose mean thickness 2·volume/area is below what a line of sight to the light's border
  /// moves sideways within one slice.
  ThinFix thin_fix = ThinFix::kOff;
  SliceRange range = SliceRange::kAuto;
  SliceCoverage coverage = SliceCoverage::kBinary;
  SliceFaces faces = SliceFaces::kFront;
  /// Distance of the center of projection behind the light, scene units, > 0; infinity is orthographic;
  /// nothing: as far as the frustum through the light's border contains the casters. Under a distant light
  /// all are orthographic.
  std::optional<double> cop_offset = {};
};

struct OcclusionFrame {
  /// One a receiver; 1 where nothing is seen.
  std::vector<float> visibility;
  std::vector<StageTime> stages;
  /// Casters, slices in use, the frustum, bytes.
  Counts counts;
  /// Coverage of each slice in use, from the light on.
  std::vector<TexturePicture> textures;
};

class OcclusionTextures {
 public:
  /// `context`, `scene` and `rays` must outlive this; the context is made current by each call. Of `rays`
  /// only the threads are used.
  OcclusionTextures(gl::Context& context, const Scene& scene, const RayScene& rays);
  ~OcclusionTextures();
  /// Visibility of receivers that are a picture's pixels and have normals, under a light that has an extent.
  /// Everything is made anew: slices, prefilters, lookups. Nothing behind the light's plane casts. Throws
  /// UsageError for options outside their range, SystemError where OpenGL fails, Cancelled. Cost O(faces +
  /// texels · slices + pixels · slices).
  OcclusionFrame render(const AreaLight& light, const Receivers& surface, const OcclusionOptions& options,
                        const Progress& progress = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
