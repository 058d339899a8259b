// The D-buffer: what the light's center sees of penumbra boundaries, and the visibility shader that reads it.
//
// In: caster meshes (uploaded once), surface points (uploaded once per camera), a light. Out: visibility per pixel.
// "Umbra and penumbra volumes" (2004), sections 3 and 4. There a texel stores the distances |cxo|, |cxuv|, |cxpv| and |cxs|;
// here it stores the occluder's face and depth and *which edge* bounds the penumbra on that line of sight, so that the
// chord it leaves of the disk is exact for the receiver (no eq. 2 and 3), and the neighbouring edge at a corner is known.
// Facets are drawn in (1/z)-linear depth and dilated by a texel, so that no texel that touches the penumbra is empty.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/gl/context.h"
#include "render/scene.h"
#include "render/stage_clock.h"
#include "render/surface_buffer.h"

namespace penumbra {

struct DBufferOptions {
  int size = 1024;  ///< texels a side of each target, 16 to 8192
};

struct DBufferFrame {
  std::vector<float> visibility;   ///< one per pixel of the surface buffer; 1 where nothing is seen
  std::vector<StageTime> stages;
  nlohmann::json counts;           ///< faces by class, edges, facets, triangles drawn, targets, bytes
};

class DBuffer {
 public:
  /// Uploads the casters. `context`, `scene` and `rays` must outlive the D-buffer; the context is made current by each
  /// call.
  DBuffer(gl::Context& context, const Scene& scene, const RayScene& rays);
  ~DBuffer();
  void set_surface(const SurfaceBuffer& surface);
  /// Everything that depends on the light is rebuilt: classes, silhouettes, facets, buffers, visibility.
  /// Throws UsageError for a size outside its range.
  DBufferFrame render(const DiskLight& light, const DBufferOptions& options);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
