// Pictures: a scene, a method and its options in; channels, stage times and counts out.
//
//   camera → surface buffer     what each pixel sees: receivers, the same for every method
//   visibility                  by the chosen method, once a light             (method.h)
//   shading                     visibility → RGB, summed over lights, the same code for every method
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "penumbra/render/image/image.h"
#include "penumbra/render/receivers/surface_buffer.h"
#include "penumbra/render/visibility.h"

namespace penumbra {

struct LightPlan;
struct PlanRequest;

/// Registers the methods that draw (OpenGL): dbuffer, occlusion-textures. Called again it does nothing.
/// Renderers call it; call it yourself to list all methods before there is one.
void register_drawing_methods();

struct RenderOptions {
  std::string method = kDefaultMethod;
  /// Those of other methods have no effect.
  OptionValues options{};
  /// Pixels, 1 to 65,536 a side.
  int width = 640, height = 480;
  /// R G B A are means over this many samples along each side of a pixel, 1 to kMostAntialias: surface,
  /// visibility and shading at the centers of as many squares. All other channels are those of the pixel's
  /// center, bit for bit what they are without. Costs as many frames as a pixel has samples, one more where
  /// the number is even, and the memory of one more frame and 32 bytes a pixel. Methods that converge take
  /// another seed for each.
  int antialias = 1;
  /// MethodFrame::textures is wanted.
  bool keep_textures = false;
  /// Of lights that reach nothing (MethodFrame::is_dark) there are neither visibility and region nor channels
  /// of the picture; add_dark_channels() adds the latter. To fill them for a hundred such lights takes longer
  /// than the frame of three that shine.
  bool leave_out_dark = false;
  /// Asked between stages and in the long ones.
  Progress progress{};
};

/// What the method did for one light.
struct MethodFrame {
  /// As in Scene::lights.
  std::string light;
  /// No pixel sees any of the light, which the method `auto` has found out without a look at each.
  bool is_dark = false;
  std::vector<float> visibility;
  std::vector<std::int8_t> region;
  StageTimes stages, setup;
  Counts counts;
  std::string renderer;
  std::vector<Decision> decisions;
  std::vector<TexturePicture> textures;
};

struct RenderResult {
  /// R G B A, visibility and region (visibility.NAME and region.NAME with several lights), object, P, N.
  Image image;
  SurfaceBuffer surface;
  std::string method;
  /// All options of the method, as used.
  OptionValues options{};
  /// One a light of the scene, in their order.
  std::vector<MethodFrame> lights;
  /// In order; times of one name are summed over lights.
  StageTimes stages;
  /// In each pixel, as RenderOptions::antialias.
  int antialias = 1;
  /// All stages that a new frame needs, all samples of a pixel among them: no one-time set-up, no file
  /// output.
  double frame_ms = 0.0;
  /// One-time set-up so far.
  StageTimes setup;
  std::size_t scene_faces = 0;
  /// Rays that the camera sent for this picture: none where it saw the same before.
  std::uint64_t camera_rays = 0;
  /// One line for each light of which nothing that is seen gets any: why that is so.
  std::vector<std::string> warnings;
};

/// Adds visibility and region of lights that reach nothing to a picture of the scene that was drawn without
/// them. `threads`: 0 for all cores. Cost O(pixels) for each.
void add_dark_channels(const Scene& scene, RenderResult& result, int threads = 0);

/// Draws pictures of a scene that it owns. What has changed since the picture before it finds out itself: the
/// camera, a light, the size, the method. What has not is kept (what the camera sees, groups of receivers,
/// classes and silhouettes, hierarchies, OpenGL contexts) and takes no time again: docs/performance.md,
/// "Between frames".
///
/// To be used by one thread at a time, and destroyed by the thread that drew (OpenGL contexts are that
/// thread's).
class Renderer {
 public:
  /// `threads`: 0 means all cores. Copies of meshes are shared, not made. Throws UsageError for a scene
  /// without lights, or with several of which two have one name or one has none.
  explicit Renderer(Scene scene, int threads = 0);
  ~Renderer();

  const Scene& scene() const;
  void set_camera(const Camera& camera);
  /// Throws UsageError for an index that no light has. The light keeps its name.
  void set_light(std::size_t index, const Light& light);

  /// Throws UsageError for an unknown method, options outside their domain, a light that is not valid or that
  /// the method does not take, a side outside 1 to 65,536, an antialias outside 1 to kMostAntialias;
  /// SceneError where something is too far from the casters (docs/scene-file.md); SystemError where OpenGL
  /// does not start; Cancelled.
  RenderResult render(const RenderOptions& options);
  /// The same into the result of an earlier call, whose memory is used again: taking new memory costs a good
  /// part of a simple frame. `out` is as that call left it, or new: what it holds of the surface is not
  /// written again where it is the same. After an exception it is fit for another call and for nothing else.
  void render(const RenderOptions& options, RenderResult& out);
  /// What the method `auto` would do for each light of a picture of that size, in their order; nothing is
  /// drawn. Throws what render() does for options, lights and places.
  std::vector<LightPlan> plan(const PlanRequest& request, int width, int height);
  /// The next picture finds everything anew but for one-time set-up, though nothing has changed: for timing.
  void forget();
  /// Shades the last picture's surface with other visibilities, one a light, one sample a pixel.
  Image shade_again(const std::vector<std::vector<float>>& visibility) const;
  int threads() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// One picture. `warm_up` pictures are drawn and thrown away before it.
RenderResult render(const Scene& scene, const RenderOptions& options, int threads = 0, int warm_up = 0);

}  // namespace penumbra
