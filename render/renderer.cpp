#include "penumbra/render/renderer.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/plan/plan.h"
#include "render/antialias.h"
#include "render/camera_views.h"
#include "render/casters_impl.h"
#include "render/d_buffer/d_buffer_method.h"
#include "render/light/valid_light.h"
#include "render/occlusion_textures/occlusion_textures_method.h"
#include "render/plan/auto_method.h"
#include "render/plan/unshadowed.h"
#include "render/receivers/unlit.h"
#include "render/scene/scene_limits.h"
#include "render/shading/glass.h"
#include "render/shading/shading.h"

namespace penumbra {
namespace {

// Of a frame's progress, what the camera's rays take.
constexpr double kLook = 0.1;

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

std::vector<LightVisibility> seen_of(const std::vector<MethodFrame>& lights) {
  std::vector<LightVisibility> seen;
  for (const MethodFrame& frame : lights) seen.push_back({frame.visibility, frame.region, frame.is_dark});
  return seen;
}

detail::ColorChannels channels_of(Image& image) {
  return {image.channels.at("R").data(), image.channels.at("G").data(), image.channels.at("B").data(),
          image.channels.at("A").data()};
}
detail::ColorChannels channels_of(Colors& colors) {
  return {colors.r.data(), colors.g.data(), colors.b.data(), colors.a.data()};
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

/// A result that holds nothing but an image and a surface to be used again.
RenderResult recycled(RenderResult result) {
  RenderResult out;
  out.image.channels = std::move(result.image.channels);
  out.surface = std::move(result.surface);
  return out;
}

bool is_same(const SurfaceBuffer& a, const SurfaceBuffer& b) {
  return a.revision != 0 && a.revision == b.revision && a.size() == b.size();
}

std::optional<std::string> why_unlit(const Light& light, const SurfaceBuffer& surface,
                                     const MethodFrame& seen) {
  if (!seen.is_dark) return why_nothing_is_lit(light, surface.receivers(), seen.visibility);
  const bool any = std::ranges::any_of(surface.object, [](std::int32_t object) { return object >= 0; });
  return any ? std::optional(why_dark(light)) : std::nullopt;
}

/// On all threads: taking the memory takes as long as filling it.
void copy(const SurfaceBuffer& from, const detail::Threads& threads, SurfaceBuffer& to) {
  to.revision = 0;  // until all of it is there
  threads->execute([&] {
    tbb::parallel_invoke([&] { to.position = from.position; }, [&] { to.normal = from.normal; },
                         [&] { to.object = from.object, to.face = from.face; });
  });
  to.width = from.width, to.height = from.height, to.revision = from.revision;
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

  /// Throws what Renderer::render does for options, lights and places.
  void require_good(const MethodInfo& info, const RenderOptions& options) const;
  /// What the camera sees; what an earlier picture saw where nothing has changed that it depends on.
  const SurfaceBuffer& look(const RenderOptions& options, const PointInPixel& at, const Progress& progress);
  struct Wanted {
    bool textures = false;
    /// Visibility of lights that reach nothing.
    bool dark = false;
  };
  /// What the surface sees of every light. Adds the time of stages to `stages`.
  std::vector<MethodFrame> see(const MethodInfo& info, const OptionValues& values,
                               const SurfaceBuffer& surface, const Wanted& wanted, const Progress& progress,
                               StageTimes& stages);
  /// Puts glass and lights that are seen over a picture.
  template <class Picture>
  void add_glass(const SurfaceBuffer& surface, const PointInPixel& at, Picture& picture);
  /// Replaces R G B A of a picture of pixels' centers by means over all samples.
  void add_samples(const MethodInfo& info, const RenderOptions& options, const Progress& progress,
                   RenderResult& out);

  Scene scene;
  Casters casters;
  detail::CameraViews views;
  /// Made when they are first needed.
  std::optional<GlassRays> glass;
};

template <class Picture>
void Renderer::State::add_glass(const SurfaceBuffer& surface, const PointInPixel& at, Picture& picture) {
  if (scene.glass.empty() && !scene.picture.show_lights) return;
  if (!glass && !scene.glass.empty()) glass.emplace(scene.glass);
  detail::add_glass(scene, glass ? &*glass : nullptr, surface, at, casters.impl().threads,
                    channels_of(picture));
}

const SurfaceBuffer& Renderer::State::look(const RenderOptions& options, const PointInPixel& at,
                                           const Progress& progress) {
  return views.see(scene, casters.impl().rays(), options.width, options.height, at, progress);
}

void Renderer::State::require_good(const MethodInfo& info, const RenderOptions& options) const {
  for (const Light& light : scene.lights) {
    require_valid(light.shape);
    require_taken(info, light.shape);
  }
  if (const std::string complaint = detail::out_of_range(scene); !complaint.empty())
    throw SceneError("scene: " + complaint);
  if (options.antialias < 1 || options.antialias > kMostAntialias)
    throw UsageError("antialias " + std::to_string(options.antialias) + " is outside 1 to " +
                     std::to_string(kMostAntialias));
}

std::vector<MethodFrame> Renderer::State::see(const MethodInfo& info, const OptionValues& values,
                                              const SurfaceBuffer& surface, const Wanted& wanted,
                                              const Progress& progress, StageTimes& stages) {
  std::vector<MethodFrame> frames;
  const auto count = static_cast<double>(scene.lights.size());
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    const auto begin = static_cast<double>(k);
    const Progress part = part_of(progress, begin / count, (begin + 1.0) / count);
    const MethodInput input{.rays = casters.impl().rays(),
                            .light = scene.lights[k].shape,
                            .receivers = surface.receivers(),
                            .options = values,
                            .keep_textures = wanted.textures,
                            .progress = part};
    MethodResult result = casters.impl().method(info).run(input);
    if (wanted.dark) detail::fill_dark(input, result);
    require_complete(info, result, surface.size());
    add_to(stages, result.stages);
    frames.push_back({.light = scene.lights[k].name,
                      .is_dark = result.is_dark,
                      .visibility = std::move(result.visibility),
                      .region = std::move(result.region),
                      .stages = std::move(result.stages),
                      .setup = std::move(result.setup),
                      .counts = std::move(result.counts),
                      .renderer = std::move(result.renderer),
                      .decisions = std::move(result.decisions),
                      .textures = std::move(result.textures)});
  }
  return frames;
}

void Renderer::State::add_samples(const MethodInfo& info, const RenderOptions& options,
                                  const Progress& progress, RenderResult& out) {
  const std::vector<PointInPixel> points = detail::samples_of_pixel(options.antialias);
  detail::ColorSums sums(out.surface.size());
  OptionValues values = out.options;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].is_center()) {
      sums.add(out.image);
      continue;
    }
    if (info.converges) values["seed"] = integer_of(values, "seed") + 1;
    const auto begin = static_cast<double>(i), count = static_cast<double>(points.size());
    const Progress frame = part_of(progress, begin / count, (begin + 1.0) / count);
    StageClock clock;
    const SurfaceBuffer& surface = look(options, points[i], part_of(frame, 0.0, kLook));
    clock.finish("surface_buffer");
    const std::vector<MethodFrame> frames =
        see(info, values, surface, {}, part_of(frame, kLook, 1.0), out.stages);
    clock.restart();
    Colors colors = shade_colors(scene, surface, seen_of(frames), casters.impl().threads);
    add_glass(surface, points[i], colors);
    sums.add(colors);
    clock.finish("shading");
    add_to(out.stages, clock.stages());
  }
  StageClock clock;
  sums.write_means(out.image);
  clock.finish("shading");
  add_to(out.stages, clock.stages());
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
  state_->views.forget();
  state_->casters.impl().forget();
}

Image Renderer::shade_again(const std::vector<std::vector<float>>& visibility) const {
  const SurfaceBuffer* surface = state_->views.last();
  if (!surface || visibility.size() != state_->scene.lights.size())
    throw UsageError("shading needs a picture and the visibility of each of its lights");
  std::vector<LightVisibility> lights;
  for (const std::vector<float>& values : visibility) {
    if (values.size() != surface->size())
      throw UsageError("shading needs as many visibilities as the picture has pixels");
    lights.push_back({values, {}});
  }
  return shade(state_->scene, *surface, lights, state_->casters.impl().threads);
}

std::vector<LightPlan> Renderer::plan(const PlanRequest& request, int width, int height) {
  const RenderOptions options{.method = "auto", .width = width, .height = height};
  state_->require_good(method_named(options.method), options);
  const SurfaceBuffer& surface = state_->look(options, {}, {});
  std::vector<LightPlan> plans;
  for (const Light& light : state_->scene.lights)
    plans.push_back(plan_light(state_->casters.impl().scene, state_->casters.impl().rays(), light.shape,
                               surface.receivers(), request));
  return plans;
}

RenderResult Renderer::render(const RenderOptions& options) {
  RenderResult out;
  render(options, out);
  return out;
}

void Renderer::render(const RenderOptions& options, RenderResult& out) {
  const MethodInfo& info = method_named(options.method);
  out = recycled(std::move(out));
  out.method = info.name;
  require_known(options.options);
  out.options = completed(info.options, options.options);
  out.antialias = options.antialias;
  state_->require_good(info, options);
  const RayScene& rays = state_->casters.impl().rays();
  StageClock clock;  // one-time set-up is no stage
  // The picture of pixels' centers, and then one for each sample.
  const double first = options.antialias > 1 ? 1.0 / (1.0 + options.antialias * options.antialias) : 1.0;
  const std::uint64_t rays_before = state_->views.rays_sent();
  const SurfaceBuffer& surface = state_->look(options, {}, part_of(options.progress, 0.0, kLook * first));
  clock.finish("surface_buffer");
  out.stages = clock.stages();
  report(options.progress, kLook * first);
  out.lights = state_->see(info, out.options, surface,
                           {.textures = options.keep_textures, .dark = !options.leave_out_dark},
                           part_of(options.progress, kLook * first, first), out.stages);
  report(options.progress, first);
  StageClock shading;
  const detail::Threads& threads = state_->casters.impl().threads;
  const bool has_surface = is_same(out.surface, surface);
  shade(state_->scene, surface, seen_of(out.lights), threads,
        {.has_surface = has_surface, .leave_out_dark = options.leave_out_dark}, out.image);
  state_->add_glass(surface, {}, out.image);
  shading.finish("shading");
  add_to(out.stages, shading.stages());
  if (!has_surface) copy(surface, threads, out.surface);
  if (options.antialias > 1) state_->add_samples(info, options, part_of(options.progress, first, 1.0), out);
  out.camera_rays = state_->views.rays_sent() - rays_before;
  report(options.progress, 1.0);
  for (const StageTime& stage : out.stages) out.frame_ms += stage.milliseconds;
  out.setup = {{"ray_scene", rays.build_ms()}};
  for (std::size_t k = 0; k < out.lights.size(); ++k) {
    add_to(out.setup, out.lights[k].setup);
    if (auto warning = why_unlit(state_->scene.lights[k], surface, out.lights[k]))
      out.warnings.push_back(std::move(*warning));
  }
  for (const SceneObject& object : state_->scene.objects) out.scene_faces += object.mesh.triangles().size();
}

void add_dark_channels(const Scene& scene, RenderResult& result, int threads) {
  detail::add_dark_channels(scene, result.surface, seen_of(result.lights), detail::make_threads(threads),
                            result.image);
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
