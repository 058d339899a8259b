#include "penumbra/render/renderer.h"

#include <algorithm>
#include <mutex>
#include <optional>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/stage_clock.h"
#include "render/casters_impl.h"
#include "render/d_buffer/d_buffer_method.h"
#include "render/light/valid_light.h"
#include "render/occlusion_textures/occlusion_textures_method.h"
#include "render/rays/camera_rays.h"
#include "render/receivers/unlit.h"
#include "render/scene/scene_limits.h"
#include "render/shading/shading.h"

namespace penumbra {
namespace {

/// Times of one name add up.
void add_to(StageTimes& sums, const StageTimes& times) {
  for (const StageTime& time : times) {
    const auto same = std::ranges::find(sums, time.name, &StageTime::name);
    if (same == sums.end())
      sums.push_back(time);
    else
      same->milliseconds += time.milliseconds;
  }
}

/// Channels of several lights have the lights' names.
void require_names(const std::vector<Light>& lights) {
  if (lights.empty()) throw UsageError("the scene has no light; add one");
  for (std::size_t i = 0; i < lights.size() && lights.size() > 1; ++i) {
    if (lights[i].name.empty())
      throw UsageError("light " + std::to_string(i) + " of several has no name; give it one");
    for (std::size_t k = 0; k < i; ++k)
      if (lights[k].name == lights[i].name)
        throw UsageError("two lights are called " + lights[i].name + "; give each a name of its own");
  }
}

}  // namespace

void register_drawing_methods() {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  for (const auto make : {d_buffer_method, occlusion_textures_method}) {
    MethodInfo method = make();
    if (std::ranges::find(methods(), method.name, &MethodInfo::name) == methods().end())
      register_method(std::move(method));
  }
}

struct Renderer::State {
  State(Scene scene_, int threads) : scene(std::move(scene_)), casters(scene.objects, threads) {}

  /// What the camera sees; that of the picture before where nothing has changed that it depends on.
  const SurfaceBuffer& look(const RenderOptions& options);

  Scene scene;
  Casters casters;
  /// What the camera saw last.
  struct Seen {
    Camera camera;
    SurfaceBuffer surface;
  };
  std::optional<Seen> seen;
};

const SurfaceBuffer& Renderer::State::look(const RenderOptions& options) {
  const bool same = seen && seen->camera == scene.camera && seen->surface.width == options.width &&
                    seen->surface.height == options.height;
  if (!same)
    seen =
        Seen{scene.camera, make_surface_buffer(scene, casters.impl().rays(), options.width, options.height)};
  return seen->surface;
}

Renderer::Renderer(Scene scene, int threads) : state_(std::make_unique<State>(std::move(scene), threads)) {
  require_names(state_->scene.lights);
  register_drawing_methods();
}
Renderer::~Renderer() = default;

const Scene& Renderer::scene() const {
  return state_->scene;
}

void Renderer::set_camera(const Camera& camera) {
  state_->scene.camera = camera;
}

void Renderer::set_light(std::size_t index, const Light& light) {
  if (index >= state_->scene.lights.size())
    throw UsageError("the scene has no light " + std::to_string(index) + "; it has " +
                     std::to_string(state_->scene.lights.size()));
  Light& mine = state_->scene.lights[index];
  mine.shape = light.shape;
  mine.radiance = light.radiance;
}

int Renderer::threads() const {
  return state_->casters.impl().threads->max_concurrency();
}

void Renderer::forget() {
  state_->seen.reset();
  state_->casters.impl().forget();
}

Image Renderer::shade_again(const std::vector<std::vector<float>>& visibility) const {
  if (!state_->seen || visibility.size() != state_->scene.lights.size())
    throw UsageError("shading needs a picture and the visibility of each of its lights");
  std::vector<LightVisibility> lights;
  for (const std::vector<float>& values : visibility) {
    if (values.size() != state_->seen->surface.size())
      throw UsageError("shading needs as many visibilities as the picture has pixels");
    lights.push_back({values, {}});
  }
  return shade(state_->scene, state_->seen->surface, lights, state_->casters.impl().threads);
}

RenderResult Renderer::render(const RenderOptions& options) {
  const MethodInfo& info = method_named(options.method);
  RenderResult out;
  out.method = info.name;
  require_known(options.options);
  out.options = completed(info.options, options.options);
  StageClock clock;
  Casters::Impl& casters = state_->casters.impl();
  const std::vector<Light>& lights = state_->scene.lights;
  for (const Light& light : lights) {
    require_valid(light.shape);
    require_taken(info, light.shape);
  }
  if (const std::string complaint = detail::out_of_range(state_->scene); !complaint.empty())
    throw SceneError("scene: " + complaint);
  const RayScene& rays = casters.rays();
  clock.restart();  // one-time set-up, not a stage
  const SurfaceBuffer& surface = state_->look(options);
  clock.finish("surface_buffer");
  report(options.progress, 0.0);
  std::vector<LightVisibility> seen;
  StageTimes setup;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    Method& method = casters.method(info);
    const Progress part = [&](double f) {
      return !options.progress ||
             options.progress((static_cast<double>(k) + f) / static_cast<double>(lights.size()));
    };
    MethodResult result = method.run({.rays = rays,
                                      .light = lights[k].shape,
                                      .receivers = surface.receivers(),
                                      .options = out.options,
                                      .keep_textures = options.keep_textures,
                                      .progress = part});
    require_complete(info, result, surface.size());
    if (auto warning = why_nothing_is_lit(lights[k], surface.receivers(), result.visibility))
      out.warnings.push_back(std::move(*warning));
    add_to(out.stages, result.stages);
    add_to(setup, result.setup);
    out.lights.push_back({.light = lights[k].name,
                          .visibility = std::move(result.visibility),
                          .region = std::move(result.region),
                          .stages = std::move(result.stages),
                          .setup = std::move(result.setup),
                          .counts = std::move(result.counts),
                          .renderer = std::move(result.renderer),
                          .textures = std::move(result.textures)});
  }
  report(options.progress, 1.0);
  for (const MethodFrame& frame : out.lights) seen.push_back({frame.visibility, frame.region});
  StageClock shading;
  out.image = shade(state_->scene, surface, seen, casters.threads);
  shading.finish("shading");
  out.surface = surface;
  StageTimes stages = clock.stages();
  add_to(stages, out.stages);
  add_to(stages, shading.stages());
  out.stages = std::move(stages);
  for (const StageTime& stage : out.stages) out.frame_ms += stage.milliseconds;
  out.setup = {{"ray_scene", rays.build_ms()}};
  add_to(out.setup, setup);
  for (const SceneObject& object : state_->scene.objects) out.scene_faces += object.mesh.triangles().size();
  return out;
}

RenderResult render(const Scene& scene, const RenderOptions& options, int threads, int warm_up) {
  Renderer renderer(scene, threads);
  for (int i = 0; i < warm_up; ++i) {
    renderer.render(options);
    renderer.forget();
  }
  return renderer.render(options);
}

}  // namespace penumbra
