#include "render/render.h"

#include <array>
#include <numeric>
#include <thread>

#include "mesh/error.h"
#include "render/ray_scene.h"
#include "render/shading.h"

namespace penumbra {
namespace {

struct NamedMethod {
  Method method;
  const char* name;
};
constexpr std::array kMethods{NamedMethod{Method::kNone, "none"}, NamedMethod{Method::kHard, "hard"},
                              NamedMethod{Method::kDBuffer, "dbuffer"},
                              NamedMethod{Method::kReference, "reference"}};

std::vector<std::uint32_t> every_pixel(const SurfaceBuffer& surface) {
  std::vector<std::uint32_t> pixels(surface.size());
  std::iota(pixels.begin(), pixels.end(), 0u);
  return pixels;
}

int used_threads(int threads) {
  return threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
}

nlohmann::json to_json(const std::vector<StageTime>& stages) {
  auto out = nlohmann::json::object();
  for (const StageTime& s : stages) out[s.name] = s.milliseconds;
  return out;
}

}  // namespace

Method method_of(const std::string& name) {
  for (const NamedMethod& m : kMethods)
    if (name == m.name) return m.method;
  std::string known;
  for (const NamedMethod& m : kMethods) known += std::string(known.empty() ? "" : ", ") + m.name;
  throw UsageError("unknown method '" + name + "': use one of " + known);
}

const char* name_of(Method method) {
  for (const NamedMethod& m : kMethods)
    if (m.method == method) return m.name;
  return "?";
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const NamedMethod& m : kMethods) names.emplace_back(m.name);
  return names;
}

struct Renderer::State {
  State(const Scene& scene_, const RenderOptions& options) : scene(scene_), rays(scene_, options.threads) {}

  const Scene& scene;
  RayScene rays;
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<DBuffer> d_buffer;
  gl::Backend backend{};

  /// Visibility by the chosen method; fills stages and stats.
  std::vector<float> visibility(const RenderOptions& options, const SurfaceBuffer& surface, StageClock& clock,
                                nlohmann::json& stats);
  std::vector<float> by_d_buffer(const RenderOptions& options, const SurfaceBuffer& surface,
                                 StageClock& clock, nlohmann::json& stats);
};

std::vector<float> Renderer::State::by_d_buffer(const RenderOptions& options, const SurfaceBuffer& surface,
                                                StageClock& clock, nlohmann::json& stats) {
  if (!d_buffer || backend != options.backend) {
    d_buffer.reset();
    context = gl::make_context(options.backend);
    backend = options.backend;
    d_buffer = std::make_unique<DBuffer>(*context, scene, rays);
    clock.restart();  // one-time set-up, not a stage
  }
  d_buffer->set_surface(surface);
  clock.finish("upload_surface");
  DBufferFrame frame = d_buffer->render(scene.light, options.d_buffer);
  for (const StageTime& s : frame.stages) clock.add(s);
  stats["renderer"] = context->renderer();
  stats["counts"] = frame.counts;
  stats["options"] = {{"dbuffer_size", options.d_buffer.size},
                      {"dbuffer", name_in(d_buffer_contents(), options.d_buffer.contents)},
                      {"dbuffer_entries", options.d_buffer.entries},
                      {"visibility", name_in(visibility_curves(), options.d_buffer.curve)},
                      {"conflict", name_in(conflicts(), options.d_buffer.conflict)},
                      {"center", name_in(center_tests(), options.d_buffer.center)},
                      {"backend", gl::name_of(options.backend)}};
  return std::move(frame.visibility);
}

std::vector<float> Renderer::State::visibility(const RenderOptions& options, const SurfaceBuffer& surface,
                                               StageClock& clock, nlohmann::json& stats) {
  const auto pixels = every_pixel(surface);
  const bool point = scene.light.radius == 0.0;
  stats["renderer"] = "Embree 3, " + std::to_string(used_threads(options.threads)) + " threads";
  if (options.method == Method::kNone) {
    std::vector<float> open(surface.size(), 1.0f);
    for (std::size_t i = 0; i < surface.size(); ++i)
      if (surface.hit(i))
        open[i] =
            static_cast<float>(fraction_above_horizon(scene.light, surface.position[i], surface.normal[i]));
    clock.finish("visibility");
    return open;
  }
  if (options.method == Method::kReference && !point) {
    ReferenceResult r =
        trace_reference(scene, rays, surface, pixels, options.reference, false, options.progress);
    clock.finish("visibility");
    stats["options"] = {{"samples", r.samples}, {"seed", options.reference.seed}};
    stats["counts"] = {{"rays", r.rays}};
    stats["mrays_per_second"] = static_cast<double>(r.rays) / (1e3 * r.milliseconds);
    return std::move(r.visibility);
  }
  if (options.method == Method::kDBuffer && !point) return by_d_buffer(options, surface, clock, stats);
  // A point light has no penumbra: every method's answer is the hard shadow.
  ReferenceResult r = trace_hard(scene, rays, surface, pixels);
  clock.finish("visibility");
  stats["counts"] = {{"rays", r.rays}};
  return std::move(r.visibility);
}

Renderer::Renderer(const Scene& scene, const RenderOptions& options)
    : state_(std::make_unique<State>(scene, options)) {}
Renderer::~Renderer() = default;

void Renderer::follow_light(const RenderOptions& options) {
  const double scale = state_->rays.frame().scale;
  state_->rays = RayScene(state_->scene, options.threads);
  if (state_->rays.frame().scale != scale) state_->d_buffer.reset();  // casters were uploaded in that scale
}

RenderResult Renderer::render_frame(const RenderOptions& options) {
  RenderResult out;
  StageClock clock;
  out.stats = {{"method", name_of(options.method)},
               {"options", nlohmann::json::object()},
               {"counts", nlohmann::json::object()}};
  out.surface = make_surface_buffer(state_->scene, state_->rays, options.width, options.height);
  clock.finish("surface_buffer");
  const std::vector<float> visibility = state_->visibility(options, out.surface, clock, out.stats);
  out.image = shade(state_->scene, out.surface, visibility, options.threads);
  clock.finish("shading");
  out.stages = clock.stages();
  for (const StageTime& s : out.stages) out.frame_ms += s.milliseconds;
  std::size_t faces = 0;
  for (const SceneObject& object : state_->scene.objects) faces += object.mesh.triangles().size();
  out.stats["stages"] = to_json(out.stages);
  out.stats["frame_ms"] = out.frame_ms;
  out.stats["setup_ms"] = {{"ray_scene", state_->rays.build_ms()}};
  out.stats["width"] = options.width;
  out.stats["height"] = options.height;
  out.stats["seed"] = options.reference.seed;
  out.stats["threads"] = used_threads(options.threads);
  out.stats["counts"]["scene_faces"] = faces;
  return out;
}

RenderResult render(const Scene& scene, const RenderOptions& options) {
  Renderer renderer(scene, options);
  for (int i = 0; i < options.warm_up; ++i) renderer.render_frame(options);
  return renderer.render_frame(options);
}

}  // namespace penumbra
