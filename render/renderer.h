// One image: scene, method and options in; channels, stage times and counts out. What `penumbra render`
// calls.
//
//   surface_buffer.h  what the camera sees          (the same points for every method)
//   visibility        by the chosen method          (reference.h, d_buffer.h, occlusion_textures.h,
//   silhouette.h, hard, none) shading.h         visibility → RGB              (the same code for every
//   method)
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/scene/scene.h"
#include "render/d_buffer/d_buffer.h"
#include "render/gl/context.h"
#include "render/image/image.h"
#include "render/occlusion_textures/occlusion_textures.h"
#include "render/rays/reference.h"
#include "render/receivers/surface_buffer.h"
#include "render/silhouette/silhouette_visibility.h"

namespace penumbra {

enum class Method { kNone, kHard, kDBuffer, kOcclusionTextures, kSilhouette, kRays, kReference };
Method method_of(const std::string& name);  ///< throws UsageError that lists the names
const char* name_of(Method method);
std::vector<std::string> method_names();

struct RenderOptions {
  Method method = Method::kDBuffer;
  int width = 640, height = 480;  ///< pixels
  int threads = 0;                ///< 0: all cores
  int warm_up = 0;                ///< frames rendered and thrown away before the one that is timed
  gl::Backend backend = gl::Backend::kOsMesa;
  ReferenceOptions reference;  ///< of the methods reference and rays
  DBufferOptions d_buffer;
  SilhouetteOptions silhouette;
  OcclusionOptions occlusion;
  bool keep_textures = false;  ///< RenderResult::textures is wanted
  bool reuse = false;          ///< what neither camera nor light has changed since the frame before serves
      ///< again (surface buffer; the D-buffer's classes, silhouettes and facets), where
      ///< follow_light was not called: the same bits, and no stage times for it
  Progress progress;  ///< asked between stages and in the long ones
};

struct RenderResult {
  Image image;  ///< every channel of the README
  SurfaceBuffer surface;
  std::vector<StageTime> stages;  ///< in order
  double frame_ms = 0.0;          ///< all stages that a new frame needs (no file output, no one-time set-up)
  nlohmann::json stats;           ///< what --stats writes
  std::vector<TexturePicture> textures;  ///< on request, of the D-buffer or the occlusion textures
};

RenderResult render(const Scene& scene, const RenderOptions& options);

/// A renderer kept between frames: context, programs and the ray scene are set up once.
class Renderer {
 public:
  explicit Renderer(const Scene& scene, const RenderOptions& options);
  ~Renderer();
  RenderResult render_frame(const RenderOptions& options);
  /// To be called when the scene's light has moved or changed its size: the rays' frame follows it, so that
  /// the next image is bit for bit that of a new renderer. What does not depend on the light is kept. Without
  /// it images are right as well, but may differ in the last digits of rays (a draft's, while a light is
  /// dragged within a few scene sizes). Cost: Embree's hierarchy is built anew.
  void follow_light(const RenderOptions& options);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra
