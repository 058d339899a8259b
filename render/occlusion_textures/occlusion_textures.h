// Occlusion textures: the scene x-rayed in slices parallel to the light, prefiltered, and looked up once a
// slice and pixel.
//
// In: casters (uploaded once), surface points. Out: visibility per pixel. "Occlusion textures" (2006). The
// cost depends neither on the light's size nor, but for one rasterisation, on the casters:
//
//   occlusion_frustum.h    from where and in which slices the casters are seen        (section 3.4)
//   occlusion_masks.h      4 to 16 slices into 1 to 4 RGBA targets, one pass, OpenGL  (section 3.4)
//   mip_pyramid.h, n_buffer.h, summed_area.h: the prefilters, in C++                  (section 3.2)
//   occlusion_lookup.h     the light's picture on each slice, and their combination   (sections 3.1, 3.3)
//
// Departures: the window of the textures is fitted to the casters and keeps only the light's proportions (the
// paper's is the light itself), which wastes no texels; kernels that jut out of it are clipped exactly.
// Prefilters and lookups are C++ on all cores: without a GPU that is faster than shaders. The receiver's
// horizon is combined like one more slice.
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

enum class OcclusionFilter {
  kMipmap,      ///< trilinear; cheapest, blocky
  kNBuffer,     ///< boxes of every power of two, placed continuously; interpolated between
  kSummedArea,  ///< every box exactly
};
enum class OcclusionCombine {
  kProduct,  ///< slices hide independent parts of the light (the paper's eq. 5)
  kSum,      ///< disjoint parts
  kMaximum,  ///< the same part
};
enum class OcclusionKernel {
  kBox,   ///< of a disk light the square of equal area; of a rectangle its own shape
  kDisk,  ///< of a disk light strips that approximate it; of a rectangle its own shape
};
enum class ThinFix { kOff, kOn, kAuto };
enum class SliceRange {
  kScene,    ///< from the nearest to the farthest point of all objects
  kCasters,  ///< of the objects that cast
  kAuto,     ///< kCasters where something that does not cast begins less than one slice of the scene's range
             ///< behind the casters' far end: contact shadows need the finer slices; else kScene
};
enum class SliceCoverage {
  kBinary,  ///< a texel is covered or not, by its center
  kArea,    ///< eight samples a texel
};
enum class SliceFaces {
  kAll,    ///< every face, as the paper
  kFront,  ///< of closed casters wholly in front of the light only what faces the center of projection
};
std::span<const NamedValue<OcclusionFilter>> occlusion_filters();
std::span<const NamedValue<OcclusionCombine>> occlusion_combines();
std::span<const NamedValue<OcclusionKernel>> occlusion_kernels();
std::span<const NamedValue<ThinFix>> thin_fixes();
std::span<const NamedValue<SliceRange>> slice_ranges();
std::span<const NamedValue<SliceCoverage>> slice_coverages();
std::span<const NamedValue<SliceFaces>> slice_faces();

struct OcclusionOptions {
  int slices = 16;         ///< 4, 8, 12 or 16, of equal thickness
  int texture_size = 512;  ///< texels a side: 128, 256, 512 or 1024
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
  /// nothing: as far as the frustum through the light's border contains the casters.
  std::optional<double> cop_offset = {};
};

struct OcclusionFrame {
  std::vector<float> visibility;  ///< one per pixel of the surface; 1 where nothing is seen
  std::vector<StageTime> stages;
  Counts counts;                         ///< slices used, frustum, bytes
  std::vector<TexturePicture> textures;  ///< coverage of each slice in use, from the light on
};

class OcclusionTextures {
 public:
  /// Uploads the casters. `context`, `scene` and `rays` must outlive this; the context is made current by each call.
  /// Of `rays` only the scale and the threads are used.
  OcclusionTextures(gl::Context& context, const Scene& scene, const RayScene& rays);
  ~OcclusionTextures();
  /// Everything is made anew for the light, a disk or a rectangle: slices, prefilters, lookups. The light must have an
  /// extent. Nothing behind its plane casts, and what is closer to it than 1/8192 of the scene
  /// is cut off. Throws UsageError for options outside their range, Cancelled.
  OcclusionFrame render(const AreaLight& light, const Receivers& surface, const OcclusionOptions& options,
                        const Progress& progress = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
