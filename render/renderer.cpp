#include "penumbra/render/renderer.h"

#include <array>
#include <cmath>
#include <numeric>
#include <thread>

#include "penumbra/mesh/error.h"
#include "render/rays/ray_scene.h"
#include "render/shading/shading.h"

namespace penumbra {
namespace {

struct NamedMethod {
  Method method;
  const char* name;
};
constexpr std::array kMethods{NamedMethod{Method::kNone, "none"},
                              NamedMethod{Method::kHard, "hard"},
                              NamedMethod{Method::kDBuffer, "dbuffer"},
                              NamedMethod{Method::kOcclusionTextures, "occlusion-textures"},
                              NamedMethod{Method::kSilhouette, "silhouette"},
                              NamedMethod{Method::kRays, "rays"},
                              NamedMethod{Method::kReference, "reference"}};

/// What a method finds out about the pixels.
struct Seen {
  std::vector<float> visibility;
  std::vector<std::int8_t> region;  ///< empty: nothing is certified
};

std::vector<std::uint32_t> every_pixel(const SurfaceBuffer& surface) {
  std::vector<std::uint32_t> pixels(surface.size());
  std::iota(pixels.begin(), pixels.end(), 0u);
  return pixels;
}

bool takes_rectangles(Method method) {
  return method == Method::kNone || method == Method::kHard || method == Method::kOcclusionTextures ||
         method == Method::kReference;
}

int used_threads(int threads) {
  return threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
}

nlohmann::json to_json(const std::vector<StageTime>& stages) {
  auto out = nlohmann::json::object();
  for (const StageTime& s : stages) out[s.name] = s.milliseconds;
  return out;
}

nlohmann::json to_json(const Counts& counts) {
  auto out = nlohmann::json::object();
  for (const Count& c : counts) std::visit([&](const auto& value) { out[c.name] = value; }, c.value);
  return out;
}

nlohmann::json to_json(const SilhouetteCounts& c) {
  return {{"faces", c.faces},
          {"casters_that_cannot_occlude", c.casters_that_cannot_occlude},
          {"mesh_edges", c.mesh_edges},
          {"band_edges", c.band_edges},
          {"cut_edges", c.cut_edges},
          {"receivers", c.receivers},
          {"merged_receivers", c.merged_receivers},
          {"certified_lit", c.certified_lit},
          {"certified_umbra", c.certified_umbra},
          {"behind_light", c.behind_light},
          {"tiles", c.tiles},
          {"empty_tiles", c.empty_tiles},
          {"listed_edges", c.listed_edges},
          {"projected_edges", c.projected_edges},
          {"segments", c.segments},
          {"integrated", c.integrated},
          {"slabs", c.slabs},
          {"row_sweeps", c.row_sweeps},
          {"overlapping", c.overlapping},
          {"rays", c.rays},
          {"second_rays", c.second_rays},
          {"fallback", c.fallback},
          {"bytes", c.bytes},
          {"hierarchy_bytes", c.hierarchy_bytes}};
}

nlohmann::json to_json(const OcclusionOptions& o) {
  nlohmann::json offset = "auto";
  if (o.cop_offset)
    offset = std::isinf(*o.cop_offset) ? nlohmann::json("orthographic") : nlohmann::json(*o.cop_offset);
  return {{"slices", o.slices},
          {"texture_size", o.texture_size},
          {"filter", name_in(occlusion_filters(), o.filter)},
          {"combine", name_in(occlusion_combines(), o.combine)},
          {"kernel", name_in(occlusion_kernels(), o.kernel)},
          {"thin_fix", name_in(thin_fixes(), o.thin_fix)},
          {"slice_range", name_in(slice_ranges(), o.range)},
          {"coverage", name_in(slice_coverages(), o.coverage)},
          {"slice_faces", name_in(slice_faces(), o.faces)},
          {"cop_offset", offset}};
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
  std::unique_ptr<OcclusionTextures> occlusion;
  gl::Backend backend{};
  /// What the camera saw last, and whether the D-buffer has it.
  struct Kept {
    Camera camera;
    SurfaceBuffer surface;
    bool in_d_buffer = false;
  };
  std::optional<Kept> kept;
  std::vector<TexturePicture> textures;  ///< of the frame under way

  /// The context that the options ask for; what was made with another goes away.
  gl::Context& context_for(const RenderOptions& options);

  /// What the camera sees, as RenderOptions::reuse says.
  SurfaceBuffer look(const RenderOptions& options);
  /// Visibility by the chosen method; fills stages and stats.
  Seen see(const RenderOptions& options, const SurfaceBuffer& surface, StageClock& clock,
           nlohmann::json& stats);
  std::vector<float> by_d_buffer(const RenderOptions& options, const SurfaceBuffer& surface,
                                 StageClock& clock, nlohmann::json& stats);
  Seen by_silhouette(const RenderOptions& options, const SurfaceBuffer& surface, StageClock& clock,
                     nlohmann::json& stats);
  std::vector<float> by_occlusion_textures(const RenderOptions& options, const SurfaceBuffer& surface,
                                           StageClock& clock, nlohmann::json& stats);
};

gl::Context& Renderer::State::context_for(const RenderOptions& options) {
  if (!context || backend != options.backend) {
    d_buffer.reset();
    occlusion.reset();
    context = gl::make_context(options.backend);
    backend = options.backend;
  }
  return *context;
}

SurfaceBuffer Renderer::State::look(const RenderOptions& options) {
  if (!options.reuse) {
    kept.reset();
    return make_surface_buffer(scene, rays, options.width, options.height);
  }
  if (!kept || kept->camera != scene.camera || kept->surface.width != options.width ||
      kept->surface.height != options.height)
    kept = {scene.camera, make_surface_buffer(scene, rays, options.width, options.height)};
  return kept->surface;
}

std::vector<float> Renderer::State::by_d_buffer(const RenderOptions& options, const SurfaceBuffer& surface,
                                                StageClock& clock, nlohmann::json& stats) {
  gl::Context& gl = context_for(options);
  if (!d_buffer) {
    d_buffer = std::make_unique<DBuffer>(gl, scene, rays);
    if (kept) kept->in_d_buffer = false;
    clock.restart();  // one-time set-up, not a stage
  }
  if (!kept || !kept->in_d_buffer) d_buffer->set_surface(surface);
  if (kept) kept->in_d_buffer = true;
  if (!options.reuse) d_buffer->forget_light();
  clock.finish("upload_surface");
  report(options.progress, 0.0);
  DBufferFrame frame = d_buffer->render(scene.light, options.d_buffer, options.progress);
  for (const StageTime& s : frame.stages) clock.add(s);
  if (options.keep_textures) textures = d_buffer->textures();
  clock.restart();
  stats["renderer"] = context->renderer();
  stats["counts"] = to_json(frame.counts);
  stats["options"] = {{"dbuffer_size", stats["counts"]["buffer_size"]},
                      {"dbuffer", name_in(d_buffer_contents(), options.d_buffer.contents)},
                      {"dbuffer_entries", options.d_buffer.entries},
                      {"visibility", name_in(visibility_curves(), options.d_buffer.curve)},
                      {"conflict", name_in(conflicts(), options.d_buffer.conflict)},
                      {"center", name_in(center_tests(), options.d_buffer.center)},
                      {"check", name_in(entry_checks(), options.d_buffer.check)},
                      {"backend", gl::name_of(options.backend)}};
  return std::move(frame.visibility);
}

/// Also the method `rays`, which traces what is not certified.
Seen Renderer::State::by_silhouette(const RenderOptions& options, const SurfaceBuffer& surface,
                                    StageClock& clock, nlohmann::json& stats) {
  SilhouetteOptions silhouette = options.silhouette;
  silhouette.integrate = options.method == Method::kSilhouette;
  SilhouetteResult r = silhouette_visibility(scene, rays, surface, silhouette, options.progress);
  for (const StageTime& s : r.stages) clock.add(s);
  if (silhouette.integrate) {
    stats["options"] = {{"rows", silhouette.rows}, {"tolerance", silhouette.tolerance}};
  } else {
    const ReferenceResult open =
        trace_reference(scene, rays, surface, r.open, options.reference, false, options.progress);
    for (std::size_t i = 0; i < r.open.size(); ++i) r.visibility[r.open[i]] = open.visibility[i];
    r.counts.rays += open.rays;
    stats["options"] = {{"samples", open.samples}, {"seed", options.reference.seed}};
    clock.finish("rays");
  }
  stats["counts"] = to_json(r.counts);
  stats["counts"]["open"] = r.open.size();
  return {std::move(r.visibility), std::move(r.region)};
}

std::vector<float> Renderer::State::by_occlusion_textures(const RenderOptions& options,
                                                          const SurfaceBuffer& surface, StageClock& clock,
                                                          nlohmann::json& stats) {
  gl::Context& gl = context_for(options);
  if (!occlusion) {
    occlusion = std::make_unique<OcclusionTextures>(gl, scene, rays);
    clock.restart();  // one-time set-up, not a stage
  }
  const OcclusionOptions& o = options.occlusion;
  OcclusionFrame frame = occlusion->render(area_light(scene), surface, o, options.progress);
  if (options.keep_textures) textures = std::move(frame.textures);
  for (const StageTime& s : frame.stages) clock.add(s);
  stats["renderer"] = context->renderer();
  stats["counts"] = to_json(frame.counts);
  stats["options"] = to_json(o);
  stats["options"]["backend"] = gl::name_of(options.backend);
  return std::move(frame.visibility);
}

Seen Renderer::State::see(const RenderOptions& options, const SurfaceBuffer& surface, StageClock& clock,
                          nlohmann::json& stats) {
  const auto pixels = every_pixel(surface);
  const bool point = scene.light.radius == 0.0;
  stats["renderer"] = "Embree 3, " + std::to_string(used_threads(options.threads)) + " threads";
  if (options.method == Method::kNone) {
    const AreaLight light = area_light(scene);
    std::vector<float> open(surface.size(), 1.0f);
    for (std::size_t i = 0; i < surface.size(); ++i)
      if (surface.hit(i))
        open[i] = static_cast<float>(fraction_above_horizon(light, surface.position[i], surface.normal[i]));
    clock.finish("visibility");
    return {std::move(open), {}};
  }
  if (options.method == Method::kReference && !point) {
    ReferenceResult r =
        trace_reference(scene, rays, surface, pixels, options.reference, false, options.progress);
    clock.finish("visibility");
    stats["options"] = {{"samples", r.samples}, {"seed", options.reference.seed}};
    stats["counts"] = {{"rays", r.rays}};
    stats["mrays_per_second"] = static_cast<double>(r.rays) / (1e3 * r.milliseconds);
    return {std::move(r.visibility), {}};
  }
  if (options.method == Method::kDBuffer && !point) return {by_d_buffer(options, surface, clock, stats), {}};
  if ((options.method == Method::kSilhouette || options.method == Method::kRays) && !point)
    return by_silhouette(options, surface, clock, stats);
  if (options.method == Method::kOcclusionTextures && !point)
    return {by_occlusion_textures(options, surface, clock, stats), {}};
  // A point light has no penumbra: every method's answer is the hard shadow.
  ReferenceResult r = trace_hard(scene, rays, surface, pixels);
  clock.finish("visibility");
  stats["counts"] = {{"rays", r.rays}};
  return {std::move(r.visibility), {}};
}

Renderer::Renderer(const Scene& scene, const RenderOptions& options)
    : state_(std::make_unique<State>(scene, options)) {}
Renderer::~Renderer() = default;

void Renderer::follow_light(const RenderOptions& options) {
  const double scale = state_->rays.frame().scale;
  state_->rays = RayScene(state_->scene, options.threads);
  state_->kept.reset();
  if (state_->rays.frame().scale != scale) state_->d_buffer.reset();  // casters were uploaded in that scale
}

RenderResult Renderer::render_frame(const RenderOptions& options) {
  if (!takes_rectangles(options.method))
    require_disk(state_->scene, "method " + std::string(name_of(options.method)));
  RenderResult out;
  StageClock clock;
  out.stats = {{"method", name_of(options.method)},
               {"options", nlohmann::json::object()},
               {"counts", nlohmann::json::object()}};
  out.surface = state_->look(options);
  clock.finish("surface_buffer");
  report(options.progress, 0.0);
  state_->textures.clear();
  const Seen seen = state_->see(options, out.surface, clock, out.stats);
  report(options.progress, 1.0);
  out.image = shade(state_->scene, out.surface, seen.visibility, options.threads, seen.region);
  clock.finish("shading");
  out.textures = std::move(state_->textures);
  out.stages = clock.stages();
  for (const StageTime& s : out.stages) out.frame_ms += s.milliseconds;
  std::size_t faces = 0;
  for (const SceneObject& object : state_->scene.objects) faces += object.mesh.triangles().size();
  out.stats["stages"] = to_json(out.stages);
  out.stats["frame_ms"] = out.frame_ms;
  out.stats["setup_ms"] = {{"ray_scene", state_->rays.build_ms()},
                           {"edge_hierarchy", state_->rays.edge_hierarchy_ms()}};
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
