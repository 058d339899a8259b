#include "render/d_buffer.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "mesh/error.h"
#include "mesh/vertex_rings.h"
#include "render/center_rays.h"
#include "render/d_buffer_passes.h"
#include "render/d_buffer_tiles.h"
#include "render/gl/state_scope.h"
#include "render/ray_scene.h"
#include "volumes/volumes.h"

namespace penumbra {
namespace {

using gl::Object;

struct Caster {
  const TriangleMesh* mesh;
  VertexRings rings;
};

glm::mat3 light_matrix(const LightFrame& axes) {
  return glm::transpose(glm::mat3(glm::vec3(axes.u), glm::vec3(axes.v), glm::vec3(axes.w)));
}

}  // namespace

struct DBuffer::Impl {
  Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_);

  void set_surface(const SurfaceBuffer& surface);
  DBufferFrame render(const DiskLight& light, const DBufferOptions& options, const Progress& progress);

  /// Where one caster's shadow is bounded.
  struct Boundary {
    Classification classes;
    Silhouettes silhouettes;
    Supports supports;
    std::vector<GapFace> gaps;
    detail::FacetReach reach;
  };
  /// What one frame knows before anything is drawn.
  struct Plan {
    detail::LightSpace space;
    glm::mat3 axes;  ///< scene frame → light's frame
    glm::vec3 offset;
    std::vector<Boundary> boundaries{};  ///< one per caster
    detail::EntryGeometry geometry{};
    std::vector<detail::Target> targets{};
  };
  struct UvWindow {
    glm::dvec2 low{1e300}, high{-1e300};
  };
  void find_boundaries(const DiskLight& light, Plan& plan, StageClock& clock) const;
  void find_geometry(const DBufferOptions& options, Plan& plan) const;
  static nlohmann::json count(const Plan& plan);
  UvWindow caster_window(const detail::LightSpace& space, double far_weight) const;
  double far_weight(const detail::LightSpace& space) const;
  void draw(const Plan& plan, const DBufferOptions& options, StageClock& clock);
  void choose_tiles(const Plan& plan, const DBufferOptions& options);
  void find_first_cut(const Plan& plan, const DiskLight& light, const DBufferOptions& options);
  void shade_pixels(const gl::Program& program, const Plan& plan, const DBufferOptions& options);
  std::vector<float> shade(const Plan& plan, const DBufferOptions& options);
  void set_uniforms(const gl::Program& program, const Plan& plan, const DBufferOptions& options) const;
  void bind_textures(const gl::Program& program) const;

  gl::Context& context;
  const gl::Functions& gl;
  const Scene& scene;
  const RayScene& rays;
  Vec3 origin;  ///< scene frame: (world - origin) · scale, about the casters
  double scale;
  std::vector<Caster> casters;

  detail::DBufferPasses passes;
  gl::Program center_program, select_program, visibility_program;
  Object framebuffer;
  std::unique_ptr<detail::DBufferLayers> layers;

  int width = 0, height = 0;
  std::unique_ptr<Object> surface_position, surface_normal, first_cut, visibility_texture, mark_texture;
  std::unique_ptr<CenterRays> center_rays;
  std::vector<glm::vec4> receivers;  ///< scene frame; the fourth number is 1 + the face's, 0: nothing seen
  Object tile_array, tile_buffer;
  GLsizei tile_vertices = 0;
};

DBuffer::Impl::Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_)
    : context(context_),
      gl(context_.functions()),
      scene(scene_),
      rays(rays_),
      scale(rays_.frame().scale),
      passes(gl),
      center_program(gl, {{GL_VERTEX_SHADER, "image_tiles.vert.glsl"},
                          {GL_FRAGMENT_SHADER, "d_buffer_center.frag.glsl"}}),
      select_program(gl, {{GL_VERTEX_SHADER, "image_tiles.vert.glsl"},
                          {GL_FRAGMENT_SHADER, "d_buffer_select.frag.glsl"}}),
      visibility_program(gl, {{GL_VERTEX_SHADER, "image_tiles.vert.glsl"},
                              {GL_FRAGMENT_SHADER, "d_buffer_visibility.frag.glsl"}}),
      framebuffer(gl, Object::Kind::kFramebuffer),
      tile_array(gl, Object::Kind::kVertexArray),
      tile_buffer(gl, Object::Kind::kBuffer) {
  const Bounds bounds = scene.caster_bounds();
  origin = bounds.empty() ? scene.light.center : bounds.center();
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> indices;
  std::vector<detail::CasterRange> ranges;
  std::uint32_t first_face = 0;
  for (const SceneObject& object : scene.objects) {
    const TriangleMesh& mesh = object.mesh;
    if (object.casts && !mesh.empty()) {
      const auto first_index = static_cast<std::uint32_t>(indices.size());
      const auto first_point = static_cast<std::uint32_t>(points.size());
      Bounds bounds_in_frame;
      for (const Vec3& p : mesh.positions()) {
        bounds_in_frame.add((p - origin) * scale);
        points.push_back(glm::vec3((p - origin) * scale));
      }
      for (const IndexedTriangle& t : mesh.triangles())
        for (std::uint32_t v : t) indices.push_back(first_point + v);
      ranges.push_back({first_face, first_index, static_cast<std::uint32_t>(indices.size()) - first_index,
                        mesh.is_closed(), bounds_in_frame});
      casters.push_back({&mesh, VertexRings(mesh)});
    }
    first_face += static_cast<std::uint32_t>(mesh.triangles().size());
  }
  passes.upload_casters(points, indices, std::move(ranges));
  gl::require_no_error(gl, "uploading casters");
}

void DBuffer::Impl::set_surface(const SurfaceBuffer& surface) {
  width = surface.width;
  height = surface.height;
  std::vector<std::uint32_t> first_face{0};
  for (const SceneObject& object : scene.objects)
    first_face.push_back(first_face.back() + static_cast<std::uint32_t>(object.mesh.triangles().size()));
  std::vector<glm::vec4>& positions = receivers;
  positions.assign(surface.size(), glm::vec4(0.0f));
  std::vector<glm::vec4> normals(surface.size(), glm::vec4(0.0f));
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (!surface.hit(i)) continue;
    const std::uint32_t face = first_face[static_cast<std::size_t>(surface.object[i])] + surface.face[i] + 1;
    positions[i] = glm::vec4(glm::vec3((surface.position[i] - origin) * scale), static_cast<float>(face));
    normals[i] = glm::vec4(glm::vec3(surface.normal[i]), 0.0f);
  }
  const auto make = [&](GLenum format, const void* texels) {
    auto texture = std::make_unique<Object>(gl, Object::Kind::kTexture);
    gl.BindTexture(GL_TEXTURE_2D, *texture);
    gl.TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    if (texels) gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, texels);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
  };
  surface_position = make(GL_RGBA32F, positions.data());
  surface_normal = make(GL_RGBA32F, normals.data());
  visibility_texture = make(GL_R32F, nullptr);
  mark_texture = make(GL_DEPTH_COMPONENT32F, nullptr);
  first_cut = make(GL_R32F, nullptr);
  center_rays = std::make_unique<CenterRays>(surface, rays);
  gl::require_no_error(gl, "uploading the surface buffer");
}

double DBuffer::Impl::far_weight(const detail::LightSpace& space) const {
  double farthest = 0.0;
  for (const SceneObject& object : scene.objects) {
    const Bounds b = bounds_of(object.mesh.positions());
    if (b.empty()) continue;
    for (int corner = 0; corner < 8; ++corner)
      farthest =
          std::max(farthest, space
                                 .to_light({corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                                            corner & 4 ? b.high.z : b.low.z})
                                 .z);
  }
  return farthest > 0.0 ? 1.0 / farthest : 1.0;
}

/// Where casters and their penumbrae are seen, in (x/z, y/z); everywhere for a caster that crosses the
/// light's plane.
DBuffer::Impl::UvWindow DBuffer::Impl::caster_window(const detail::LightSpace& space, double far) const {
  UvWindow window;
  for (const Caster& caster : casters) {
    std::size_t behind = 0;
    for (const Vec3& world : caster.mesh->positions()) {
      const Vec3 p = space.to_light(world);
      if (p.z < detail::kNearDepth) {
        ++behind;
        continue;
      }
      const glm::dvec2 uv = glm::dvec2(p.x, p.y) / p.z;
      const double reach = space.radius * std::max(0.0, 1.0 / p.z - far);
      window.low = glm::min(window.low, uv - reach);
      window.high = glm::max(window.high, uv + reach);
    }
    if (behind > 0 && behind < caster.mesh->positions().size()) return {glm::dvec2(-1e9), glm::dvec2(1e9)};
  }
  return window;
}

/// Classes to reach, stage by stage over all casters.
void DBuffer::Impl::find_boundaries(const DiskLight& light, Plan& plan, StageClock& clock) const {
  plan.boundaries.resize(casters.size());
  const auto stage = [&](const char* name, const auto& body) {
    for (std::size_t i = 0; i < casters.size(); ++i) body(casters[i], plan.boundaries[i]);
    clock.finish(name);
  };
  stage("classify", [&](const Caster& c, Boundary& b) { b.classes = classify_faces(*c.mesh, light); });
  stage("silhouette",
        [&](const Caster& c, Boundary& b) { b.silhouettes = find_silhouettes(*c.mesh, b.classes); });
  stage("supports", [&](const Caster& c, Boundary& b) {
    b.supports = find_supports(*c.mesh, c.rings, light, b.silhouettes);
    b.gaps = find_gap_faces(*c.mesh, light, b.classes, b.supports);
  });
  stage("reach", [&](const Caster& c, Boundary& b) {
    b.reach = detail::find_reach(*c.mesh, light, b.supports, rays);
  });
}

/// Targets, and everything that is drawn into them.
void DBuffer::Impl::find_geometry(const DBufferOptions& options, Plan& plan) const {
  const double far = far_weight(plan.space);
  const UvWindow window = caster_window(plan.space, far);
  plan.targets = detail::choose_targets(window.low, window.high, options.size);
  if (plan.targets.empty()) return;
  const bool hemicube = plan.targets.size() > 1;
  const auto& w = plan.targets[0].window;
  const double texel = std::max(w[1] - w[0], w[3] - w[2]) / options.size;
  const detail::EntryGeometryOptions entry{detail::kNearDepth, far, texel, hemicube};
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const Boundary& b = plan.boundaries[i];
    detail::append_entry_geometry({*casters[i].mesh, plan.space, b.supports, b.gaps, b.reach}, entry,
                                  plan.geometry);
  }
  detail::sort_by_geometry(plan.geometry);
}

nlohmann::json DBuffer::Impl::count(const Plan& plan) {
  std::size_t faces = 0, mixed = 0, umbra = 0, penumbra = 0, band = 0, facets = 0, cones = 0;
  for (const Boundary& b : plan.boundaries) {
    faces += b.classes.faces.size();
    mixed += b.classes.mixed;
    umbra += b.silhouettes.umbra.size();
    penumbra += b.silhouettes.penumbra.size();
    band += b.silhouettes.band.size();
    facets += b.supports.facets.size();
    cones += b.supports.cones.size();
  }
  return {{"faces", faces},
          {"mixed_faces", mixed},
          {"umbra_edges", umbra},
          {"penumbra_edges", penumbra},
          {"band_edges", band},
          {"facets", facets},
          {"cone_sectors", cones},
          {"targets", plan.targets.size()},
          {"entry_triangles", (plan.geometry.penumbra.size() + plan.geometry.umbra.size()) / 3}};
}

void DBuffer::Impl::draw(const Plan& plan, const DBufferOptions& options, StageClock& clock) {
  const int count = std::max(1, static_cast<int>(plan.targets.size()));
  if (!layers || layers->size != options.size || layers->count != count ||
      layers->entries != options.entries) {
    layers.reset();  // before the new ones take memory
    layers = std::make_unique<detail::DBufferLayers>(gl, options.size, count, options.entries);
  }
  passes.upload_entries(plan.geometry);
  gl.Finish();
  clock.finish("upload");

  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, options.size, options.size);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  passes.draw_occluders(plan.targets, plan.axes, plan.offset, *layers, options);
  gl.Finish();
  clock.finish("occluders");
  passes.draw_entries(plan.targets, *layers, options);
  gl.Finish();
  clock.finish("entries");
}

void DBuffer::Impl::set_uniforms(const gl::Program& program, const Plan& plan,
                                 const DBufferOptions& options) const {
  const auto at = [&](const char* name) { return program.uniform(name); };
  gl.UniformMatrix3fv(at("light_axes"), 1, GL_FALSE, &plan.axes[0][0]);
  gl.Uniform3f(at("light_offset"), plan.offset.x, plan.offset.y, plan.offset.z);
  gl.Uniform1f(at("radius"), static_cast<float>(plan.space.radius));
  gl.Uniform1f(at("near_depth"), static_cast<float>(detail::kNearDepth));
  gl.Uniform1i(at("contents"), static_cast<int>(options.contents));
  gl.Uniform1i(at("curve"), static_cast<int>(options.curve));
  gl.Uniform1i(at("two_entries"), options.entries > 1);
  gl.Uniform1i(at("target_count"), static_cast<int>(plan.targets.size()));
  std::vector<glm::mat3> axes;
  std::vector<glm::vec4> windows;
  for (const detail::Target& t : plan.targets) {
    axes.emplace_back(t.axes);
    windows.emplace_back(t.window[0], t.window[1], t.window[2], t.window[3]);
  }
  if (axes.empty()) return;
  gl.UniformMatrix3fv(at("target_axes"), static_cast<GLsizei>(axes.size()), GL_FALSE, &axes[0][0][0]);
  gl.Uniform4fv(at("target_window"), static_cast<GLsizei>(windows.size()), &windows[0][0]);
}

void DBuffer::Impl::bind_textures(const gl::Program& program) const {
  struct Binding {
    const char* name;
    GLenum kind;
    GLuint texture;
  };
  constexpr GLenum kArray = GL_TEXTURE_2D_ARRAY;
  const detail::DBufferLayers& l = *layers;
  const Binding bindings[] = {
      {"surface_position", GL_TEXTURE_2D, *surface_position},
      {"surface_normal", GL_TEXTURE_2D, *surface_normal},
      {"first_cut", GL_TEXTURE_2D, *first_cut},
      {"occluder_face", kArray, l.occluder.id.texture},
      {"occluder_depth", kArray, l.occluder.depth.texture},
      {"last_depth", kArray, l.last.texture},
      {"penumbra_entry", kArray, l.penumbra.first.id.texture},
      {"penumbra_depth", kArray, l.penumbra.first.depth.texture},
      {"above_entry", kArray, l.above.first.id.texture},
      {"above_depth", kArray, l.above.first.depth.texture},
      {"below_entry", kArray, l.below.first.id.texture},
      {"below_depth", kArray, l.below.first.depth.texture},
      {"penumbra_second", kArray, l.penumbra.second.id.texture},
      {"penumbra_second_depth", kArray, l.penumbra.second.depth.texture},
      {"above_second", kArray, l.above.second.id.texture},
      {"above_second_depth", kArray, l.above.second.depth.texture},
      {"below_second", kArray, l.below.second.id.texture},
      {"below_second_depth", kArray, l.below.second.depth.texture},
      {"records", GL_TEXTURE_BUFFER, passes.records()},
  };
  int unit = 0;
  for (const Binding& b : bindings) {
    gl.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    gl.BindTexture(b.kind, b.texture);
    gl.Uniform1i(program.uniform(b.name), unit++);
  }
  gl.ActiveTexture(GL_TEXTURE0);
}

/// The parts of the image that the shading passes visit, at depth 0.5.
void DBuffer::Impl::choose_tiles(const Plan& plan, const DBufferOptions& options) {
  const bool known = options.center == CenterTest::kRay && plan.targets.size() <= 1;
  std::vector<glm::vec2> tiles;
  if (!known)
    tiles = detail::whole_image();
  else if (!plan.targets.empty())
    tiles = detail::tiles_with_entries({width, height, receivers, plan.axes, plan.offset}, plan.geometry,
                                       plan.targets[0]);
  tile_vertices = static_cast<GLsizei>(tiles.size());
  gl.BindVertexArray(tile_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, tile_buffer);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tiles.size() * sizeof(glm::vec2)), tiles.data(),
                GL_STREAM_DRAW);
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(glm::vec2), nullptr);
  gl.EnableVertexAttribArray(0);
}

void DBuffer::Impl::shade_pixels(const gl::Program& program, const Plan& plan,
                                 const DBufferOptions& options) {
  program.use();
  set_uniforms(program, plan, options);
  bind_textures(program);
  gl.DrawArrays(GL_TRIANGLES, 0, tile_vertices);
}

/// Fills `first_cut`: where the line from the light's center to each receiver is cut first; and visibility as
/// it is where no entry applies.
void DBuffer::Impl::find_first_cut(const Plan& plan, const DiskLight& light, const DBufferOptions& options) {
  if (options.center == CenterTest::kRay) {
    const std::vector<float> cut = center_rays->first_cut(light);
    gl.BindTexture(GL_TEXTURE_2D, *first_cut);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RED, GL_FLOAT, cut.data());
    std::vector<float> without_entries = center_rays->above_horizon(light);
    for (std::size_t i = 0; i < cut.size(); ++i)
      if (cut[i] < 1.0f) without_entries[i] = 0.0f;
    gl.BindTexture(GL_TEXTURE_2D, *visibility_texture);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RED, GL_FLOAT, without_entries.data());
    return;
  }
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *first_cut, 0);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
  gl::require_complete_framebuffer(gl, "testing the light's center");
  gl.Viewport(0, 0, width, height);
  gl.DepthFunc(GL_ALWAYS);
  shade_pixels(center_program, plan, options);
  gl.Finish();
}

/// Two passes over the image: most pixels are decided by the first, the rest are marked by its depth for the
/// second.
std::vector<float> DBuffer::Impl::shade(const Plan& plan, const DBufferOptions& options) {
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *visibility_texture, 0);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, *mark_texture, 0);
  const GLenum color = GL_COLOR_ATTACHMENT0;
  gl.DrawBuffers(1, &color);
  gl::require_complete_framebuffer(gl, "shading from the D-buffer");
  gl.Viewport(0, 0, width, height);
  for (const gl::Program* program : {&select_program, &visibility_program}) {
    gl.DepthFunc(program == &select_program ? GL_ALWAYS : GL_LESS);  // tiles lie at depth 0.5
    shade_pixels(*program, plan, options);
  }
  gl.Finish();
  std::vector<float> out(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.ReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, out.data());
  return out;
}

DBufferFrame DBuffer::Impl::render(const DiskLight& light, const DBufferOptions& options,
                                   const Progress& progress) {
  DBufferFrame frame;
  StageClock clock;
  const detail::LightSpace space(light, scale);
  Plan plan{space, light_matrix(space.axes), glm::vec3(space.to_light(origin))};
  find_boundaries(light, plan, clock);
  find_geometry(options, plan);
  clock.finish("facets");
  frame.counts = count(plan);
  report(progress, 0.2);
  draw(plan, options, clock);
  report(progress, 0.5);
  choose_tiles(plan, options);
  find_first_cut(plan, light, options);
  clock.finish("center");
  report(progress, 0.7);
  frame.visibility = shade(plan, options);
  clock.finish("visibility");
  gl::require_no_error(gl, "rendering the D-buffer");
  frame.counts["buffer_bytes"] = layers->bytes();
  frame.stages = clock.stages();
  return frame;
}

std::span<const NamedValue<DBufferContents>> d_buffer_contents() {
  static constexpr NamedValue<DBufferContents> kNames[] = {{DBufferContents::kEdge, "edge"},
                                                           {DBufferContents::kDistances, "distances"}};
  return kNames;
}

std::span<const NamedValue<VisibilityCurve>> visibility_curves() {
  static constexpr NamedValue<VisibilityCurve> kNames[] = {{VisibilityCurve::kExact, "exact"},
                                                           {VisibilityCurve::kSmoothstep, "smoothstep"},
                                                           {VisibilityCurve::kSquareRoot, "sqrt"}};
  return kNames;
}

std::span<const NamedValue<CenterTest>> center_tests() {
  static constexpr NamedValue<CenterTest> kNames[] = {{CenterTest::kRay, "ray"},
                                                      {CenterTest::kDepth, "depth"}};
  return kNames;
}

std::span<const NamedValue<Conflict>> conflicts() {
  static constexpr NamedValue<Conflict> kNames[] = {{Conflict::kNearest, "nearest"},
                                                    {Conflict::kFurthest, "furthest"}};
  return kNames;
}

DBuffer::DBuffer(gl::Context& context, const Scene& scene, const RayScene& rays) {
  context.make_current();
  const gl::StateScope scope(context.functions());
  impl_ = std::make_unique<Impl>(context, scene, rays);
}

DBuffer::~DBuffer() {
  if (impl_) impl_->context.make_current();
}

void DBuffer::set_surface(const SurfaceBuffer& surface) {
  impl_->context.make_current();
  const gl::StateScope scope(impl_->gl);
  impl_->set_surface(surface);
}

DBufferFrame DBuffer::render(const DiskLight& light, const DBufferOptions& options,
                             const Progress& progress) {
  if (options.size < 16 || options.size > 8192)
    throw UsageError("D-buffer size must lie in 16 to 8192 texels, not " + std::to_string(options.size));
  if (options.entries < 1 || options.entries > 2)
    throw UsageError("D-buffer entries must be 1 or 2, not " + std::to_string(options.entries));
  if (options.entries == 2 &&
      (options.contents != DBufferContents::kEdge || options.conflict != Conflict::kNearest))
    throw UsageError("two D-buffer entries need --dbuffer edge and --conflict nearest");
  if (impl_->width == 0) throw UsageError("DBuffer::set_surface has to come before render");
  impl_->context.make_current();
  const gl::StateScope scope(impl_->gl);
  return impl_->render(light, options, progress);
}

}  // namespace penumbra
