#include "render/d_buffer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "mesh/error.h"
#include "mesh/vertex_rings.h"
#include "render/d_buffer_geometry.h"
#include "render/d_buffer_targets.h"
#include "render/gl/program.h"
#include "render/ray_scene.h"
#include "volumes/volumes.h"

namespace penumbra {
namespace {

using gl::Object;
constexpr int kMaxTargets = 5;

/// Nothing nearer to the light's plane than this (of the scene's size) is drawn: casters are cut there.
constexpr double kNearDepth = 0x1p-13;

struct Caster {
  const TriangleMesh* mesh;
  std::size_t object;
  VertexRings rings;
  std::uint32_t first_face, first_index;
};

/// A layered texture of one size.
struct Layers {
  Layers(const gl::Functions& gl, GLenum format, int size, int count) : texture(gl, Object::Kind::kTexture) {
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    gl.TexStorage3D(GL_TEXTURE_2D_ARRAY, 1, format, size, size, count);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  Object texture;
};

/// An id and a depth a texel: the occluder's, or the nearest entry's.
struct Layer {
  Layer(const gl::Functions& gl, int size, int count)
      : id(gl, GL_R32UI, size, count), depth(gl, GL_DEPTH_COMPONENT32F, size, count) {}
  Layers id, depth;
};

struct Buffers {
  Buffers(const gl::Functions& gl, int size_, int count_)
      : size(size_), count(count_), occluder(gl, size_, count_), last(gl, GL_DEPTH_COMPONENT32F, size_, count_),
        penumbra(gl, size_, count_), umbra_above(gl, size_, count_), umbra_below(gl, size_, count_) {}
  int size, count;
  Layer occluder;     ///< the first surface
  Layers last;        ///< depth of the last surface that faces the light's center
  Layer penumbra;     ///< nearest penumbra entry in front of the first surface
  Layer umbra_above;  ///< nearest umbra entry in front of the last surface
  Layer umbra_below;  ///< nearest umbra entry behind the last surface
};

glm::mat3 light_matrix(const LightFrame& axes) {
  return glm::transpose(glm::mat3(glm::vec3(axes.u), glm::vec3(axes.v), glm::vec3(axes.w)));
}

}  // namespace

struct DBuffer::Impl {
  Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_);

  void set_surface(const SurfaceBuffer& surface);
  DBufferFrame render(const DiskLight& light, const DBufferOptions& options);

  /// What one frame knows before anything is drawn.
  struct Plan {
    detail::LightSpace space;
    std::vector<Supports> supports;
    detail::EntryGeometry geometry;
    std::vector<detail::Target> targets;
    glm::mat3 axes;
    glm::vec3 offset;
  };
  void find_geometry(const DiskLight& light, const DBufferOptions& options, Plan& plan, StageClock& clock,
                     nlohmann::json& counts) const;
  void caster_window(const detail::LightSpace& space, double far_weight, glm::dvec2& low, glm::dvec2& high) const;
  double far_weight(const detail::LightSpace& space) const;
  void upload(const Plan& plan);
  void draw_casters(std::size_t target, const Plan& plan, bool cull);
  void draw_occluders(const Plan& plan);
  enum class Against { kFirst, kLast, kBehindLast };
  void draw_entries(const Plan& plan, const Layer& layer, const std::vector<detail::EntryVertex>& triangles,
                    const Object& vertices, Against against);
  std::vector<float> shade(const Plan& plan);

  void set_target(const gl::Program& program, const detail::Target& target) const;
  void set_light(const gl::Program& program, const Plan& plan) const;
  void attach(const Layer& layer, int index) const;
  void bind(int unit, GLenum kind, GLuint texture) const;

  gl::Context& context;
  const gl::Functions& gl;
  const Scene& scene;
  const RayScene& rays;
  Vec3 origin;   ///< scene frame: (world - origin) · scale, about the casters
  double scale;
  std::vector<Caster> casters;

  gl::Program occluder_program, entry_program, behind_program, visibility_program;
  Object caster_points, caster_indices, caster_array, penumbra_vertices, umbra_vertices, entry_array, empty_array,
      record_buffer, record_texture, framebuffer;
  std::unique_ptr<Buffers> buffers;

  int width = 0, height = 0;
  std::unique_ptr<Object> surface_position, surface_normal, visibility_texture;
};

DBuffer::Impl::Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_)
    : context(context_), gl(context_.functions()), scene(scene_), rays(rays_),
      occluder_program(gl, {{GL_VERTEX_SHADER, "d_buffer_occluder.vert.glsl"},
                            {GL_FRAGMENT_SHADER, "d_buffer_occluder.frag.glsl"}}),
      entry_program(gl, {{GL_VERTEX_SHADER, "d_buffer_entry.vert.glsl"}, {GL_FRAGMENT_SHADER, "d_buffer_entry.frag.glsl"}}),
      behind_program(gl, {{GL_VERTEX_SHADER, "d_buffer_entry.vert.glsl"},
                          {GL_FRAGMENT_SHADER, "d_buffer_entry_behind.frag.glsl"}}),
      visibility_program(gl, {{GL_VERTEX_SHADER, "full_screen.vert.glsl"},
                              {GL_FRAGMENT_SHADER, "d_buffer_visibility.frag.glsl"}}),
      caster_points(gl, Object::Kind::kBuffer), caster_indices(gl, Object::Kind::kBuffer),
      caster_array(gl, Object::Kind::kVertexArray), penumbra_vertices(gl, Object::Kind::kBuffer),
      umbra_vertices(gl, Object::Kind::kBuffer), entry_array(gl, Object::Kind::kVertexArray),
      empty_array(gl, Object::Kind::kVertexArray), record_buffer(gl, Object::Kind::kBuffer),
      record_texture(gl, Object::Kind::kTexture), framebuffer(gl, Object::Kind::kFramebuffer) {
  scale = rays.frame().scale;
  const Bounds bounds = scene.caster_bounds();
  origin = bounds.empty() ? scene.light.center : bounds.center();
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> indices;
  std::uint32_t first_face = 0;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const TriangleMesh& mesh = scene.objects[i].mesh;
    if (scene.objects[i].casts && !mesh.empty()) {
      casters.push_back({&mesh, i, VertexRings(mesh), first_face, static_cast<std::uint32_t>(indices.size())});
      const auto first_point = static_cast<std::uint32_t>(points.size());
      for (const Vec3& p : mesh.positions()) points.push_back(glm::vec3((p - origin) * scale));
      for (const IndexedTriangle& t : mesh.triangles())
        for (std::uint32_t v : t) indices.push_back(first_point + v);
    }
    first_face += static_cast<std::uint32_t>(mesh.triangles().size());
  }
  gl.BindVertexArray(caster_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, caster_points);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(glm::vec3)), points.data(), GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, caster_indices);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
                GL_STATIC_DRAW);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  gl.EnableVertexAttribArray(0);
  gl::require_no_error(gl, "uploading casters");
}

void DBuffer::Impl::set_surface(const SurfaceBuffer& surface) {
  width = surface.width;
  height = surface.height;
  std::vector<std::uint32_t> first_face{0};
  for (const SceneObject& object : scene.objects)
    first_face.push_back(first_face.back() + static_cast<std::uint32_t>(object.mesh.triangles().size()));
  std::vector<glm::vec4> positions(surface.size(), glm::vec4(0.0f)), normals(surface.size(), glm::vec4(0.0f));
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (!surface.hit(i)) continue;
    const std::uint32_t face = first_face[static_cast<std::size_t>(surface.object[i])] + surface.face[i] + 1;
    positions[i] = glm::vec4(glm::vec3((surface.position[i] - origin) * scale), std::bit_cast<float>(face));
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
  gl::require_no_error(gl, "uploading the surface buffer");
}

double DBuffer::Impl::far_weight(const detail::LightSpace& space) const {
  double farthest = 0.0;
  for (const SceneObject& object : scene.objects) {
    const Bounds b = bounds_of(object.mesh.positions());
    if (b.empty()) continue;
    for (int corner = 0; corner < 8; ++corner)
      farthest = std::max(farthest, space.to_light({corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                                                    corner & 4 ? b.high.z : b.low.z}).z);
  }
  return farthest > 0.0 ? 1.0 / farthest : 1.0;
}

/// Where casters and their penumbrae are seen, in (x/z, y/z); everywhere for a caster that crosses the light's plane.
void DBuffer::Impl::caster_window(const detail::LightSpace& space, double far, glm::dvec2& low, glm::dvec2& high) const {
  low = glm::dvec2(1e300);
  high = glm::dvec2(-1e300);
  for (const Caster& caster : casters) {
    std::size_t behind = 0;
    for (const Vec3& world : caster.mesh->positions()) {
      const Vec3 p = space.to_light(world);
      if (p.z < kNearDepth) {
        ++behind;
        continue;
      }
      const glm::dvec2 uv = glm::dvec2(p.x, p.y) / p.z;
      const double reach = space.radius * std::max(0.0, 1.0 / p.z - far);
      low = glm::min(low, uv - reach);
      high = glm::max(high, uv + reach);
    }
    if (behind > 0 && behind < caster.mesh->positions().size()) low = glm::dvec2(-1e9), high = glm::dvec2(1e9);
  }
}

void DBuffer::Impl::find_geometry(const DiskLight& light, const DBufferOptions& options, Plan& plan, StageClock& clock,
                                  nlohmann::json& counts) const {
  std::vector<Classification> classes;
  for (const Caster& caster : casters) classes.push_back(classify_faces(*caster.mesh, light));
  clock.finish("classify");
  std::vector<Silhouettes> silhouettes;
  for (std::size_t i = 0; i < casters.size(); ++i) silhouettes.push_back(find_silhouettes(*casters[i].mesh, classes[i]));
  clock.finish("silhouette");
  for (std::size_t i = 0; i < casters.size(); ++i)
    plan.supports.push_back(find_supports(*casters[i].mesh, casters[i].rings, light, classes[i], silhouettes[i]));
  clock.finish("supports");
  std::vector<detail::FacetReach> reach;
  for (std::size_t i = 0; i < casters.size(); ++i)
    reach.push_back(detail::find_reach(*casters[i].mesh, light, plan.supports[i], rays));
  clock.finish("reach");
  glm::dvec2 low, high;
  const double far = far_weight(plan.space);
  caster_window(plan.space, far, low, high);
  const double widest = std::max({1.0, std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
  const bool hemicube = widest > detail::kWidestWindow;
  const double texel = (hemicube ? 2.0 : std::max(high.x - low.x, high.y - low.y)) / (options.size - 4);
  plan.targets = detail::choose_targets(low - 2.0 * texel, high + 2.0 * texel);
  const detail::EntryGeometryOptions entry{kNearDepth, far, texel};
  for (std::size_t i = 0; i < casters.size(); ++i)
    detail::append_entry_geometry(*casters[i].mesh, plan.space, plan.supports[i], reach[i], entry,
                                  plan.geometry);
  clock.finish("facets");

  std::size_t faces = 0, mixed = 0, umbra = 0, penumbra = 0, band = 0, facets = 0, cones = 0;
  for (std::size_t i = 0; i < casters.size(); ++i) {
    faces += classes[i].faces.size();
    mixed += classes[i].mixed;
    umbra += silhouettes[i].umbra.size();
    penumbra += silhouettes[i].penumbra.size();
    band += silhouettes[i].band.size();
    facets += plan.supports[i].facets.size();
    cones += plan.supports[i].cones.size();
  }
  counts = {{"faces", faces}, {"mixed_faces", mixed}, {"umbra_edges", umbra}, {"penumbra_edges", penumbra},
            {"band_edges", band}, {"facets", facets}, {"cone_sectors", cones}, {"targets", plan.targets.size()},
            {"entry_triangles", (plan.geometry.penumbra.size() + plan.geometry.umbra.size()) / 3},
            {"buffer_bytes", plan.targets.size() * 3 * 8 * static_cast<std::size_t>(options.size) *
                                 static_cast<std::size_t>(options.size)}};
}

void DBuffer::Impl::upload(const Plan& plan) {
  const auto fill = [&](GLenum kind, const Object& buffer, const auto& data) {
    gl.BindBuffer(kind, buffer);
    gl.BufferData(kind, static_cast<GLsizeiptr>(data.size() * sizeof(data[0])), data.data(), GL_STREAM_DRAW);
  };
  fill(GL_ARRAY_BUFFER, penumbra_vertices, plan.geometry.penumbra);
  fill(GL_ARRAY_BUFFER, umbra_vertices, plan.geometry.umbra);
  fill(GL_TEXTURE_BUFFER, record_buffer, plan.geometry.records);
  gl.BindTexture(GL_TEXTURE_BUFFER, record_texture);
  gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, record_buffer);
}

void DBuffer::Impl::set_target(const gl::Program& program, const detail::Target& target) const {
  const glm::mat3 axes(target.axes);
  const float window[4] = {static_cast<float>(target.window[0]), static_cast<float>(target.window[1]),
                           static_cast<float>(target.window[2]), static_cast<float>(target.window[3])};
  gl.UniformMatrix3fv(program.uniform("target_axes"), 1, GL_FALSE, &axes[0][0]);
  gl.Uniform4fv(program.uniform("target_window"), 1, window);
  gl.Uniform1f(program.uniform("near_depth"), static_cast<float>(kNearDepth));
}

void DBuffer::Impl::set_light(const gl::Program& program, const Plan& plan) const {
  gl.UniformMatrix3fv(program.uniform("light_axes"), 1, GL_FALSE, &plan.axes[0][0]);
  gl.Uniform3f(program.uniform("light_offset"), plan.offset.x, plan.offset.y, plan.offset.z);
}

void DBuffer::Impl::attach(const Layer& layer, int index) const {
  gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, layer.id.texture, 0, index);
  gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, layer.depth.texture, 0, index);
  const GLenum color = GL_COLOR_ATTACHMENT0;
  gl.DrawBuffers(1, &color);
}

/// `cull`: only faces towards the light's center, where a caster has an inside.
void DBuffer::Impl::draw_casters(std::size_t target, const Plan& plan, bool cull) {
  set_target(occluder_program, plan.targets[target]);
  for (const Caster& caster : casters) {
    if (cull && caster.mesh->is_closed()) gl.Enable(GL_CULL_FACE);
    gl.Uniform1ui(occluder_program.uniform("first_face"), caster.first_face);
    const auto* first = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(caster.first_index) * 4);
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * caster.mesh->triangles().size()), GL_UNSIGNED_INT, first);
    gl.Disable(GL_CULL_FACE);
  }
}

/// First surface of all; then the last of those that face the light's center.
void DBuffer::Impl::draw_occluders(const Plan& plan) {
  occluder_program.use();
  set_light(occluder_program, plan);
  gl.BindVertexArray(caster_array);
  gl.Enable(GL_CLIP_DISTANCE0);
  gl.CullFace(GL_FRONT);  // targets look along right × up, which turns windings over
  const GLuint none[4] = {0, 0, 0, 0};
  const float farthest = 0.0f, nearest = 1.0f;
  for (std::size_t i = 0; i < plan.targets.size(); ++i) {
    attach(buffers->occluder, static_cast<int>(i));
    gl.ClearBufferuiv(GL_COLOR, 0, none);
    gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
    draw_casters(i, plan, false);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, buffers->last.texture, 0, static_cast<int>(i));
    gl.ClearBufferfv(GL_DEPTH, 0, &nearest);
    gl.DepthFunc(GL_LESS);
    draw_casters(i, plan, true);
    gl.DepthFunc(GL_GREATER);
  }
  gl.Disable(GL_CLIP_DISTANCE0);
}

void DBuffer::Impl::draw_entries(const Plan& plan, const Layer& layer, const std::vector<detail::EntryVertex>& triangles,
                                 const Object& vertices, Against against) {
  const gl::Program& program = against == Against::kBehindLast ? behind_program : entry_program;
  program.use();
  gl.BindVertexArray(entry_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(detail::EntryVertex), nullptr);
  gl.VertexAttribIPointer(1, 1, GL_UNSIGNED_INT, sizeof(detail::EntryVertex), reinterpret_cast<const void*>(12));
  gl.EnableVertexAttribArray(0);
  gl.EnableVertexAttribArray(1);
  const GLuint none[4] = {0, 0, 0, 0};
  const float farthest = 0.0f;
  // A layer that starts with a surface's depth keeps only entries in front of it.
  if (against != Against::kBehindLast) {
    const GLuint from = against == Against::kFirst ? buffers->occluder.depth.texture : buffers->last.texture;
    gl.CopyImageSubData(from, GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, layer.depth.texture, GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0,
                        buffers->size, buffers->size, buffers->count);
  } else {
    bind(0, GL_TEXTURE_2D_ARRAY, buffers->last.texture);
    gl.Uniform1i(program.uniform("last_depth"), 0);
  }
  for (std::size_t i = 0; i < plan.targets.size(); ++i) {
    attach(layer, static_cast<int>(i));
    gl.ClearBufferuiv(GL_COLOR, 0, none);
    if (against == Against::kBehindLast) {
      gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
      gl.Uniform1i(program.uniform("layer"), static_cast<int>(i));
    }
    set_target(program, plan.targets[i]);
    gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
  }
}

void DBuffer::Impl::bind(int unit, GLenum kind, GLuint texture) const {
  gl.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  gl.BindTexture(kind, texture);
}

std::vector<float> DBuffer::Impl::shade(const Plan& plan) {
  gl.BindVertexArray(empty_array);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *visibility_texture, 0);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
  gl.Disable(GL_DEPTH_TEST);
  gl.Viewport(0, 0, width, height);
  visibility_program.use();
  set_light(visibility_program, plan);
  gl.Uniform1f(visibility_program.uniform("radius"), static_cast<float>(plan.space.radius));
  gl.Uniform1f(visibility_program.uniform("near_depth"), static_cast<float>(kNearDepth));
  gl.Uniform1i(visibility_program.uniform("target_count"), static_cast<int>(plan.targets.size()));
  std::vector<glm::mat3> axes;
  std::vector<glm::vec4> windows;
  for (const detail::Target& t : plan.targets) {
    axes.emplace_back(t.axes);
    windows.emplace_back(t.window[0], t.window[1], t.window[2], t.window[3]);
  }
  if (!axes.empty()) {
    gl.UniformMatrix3fv(visibility_program.uniform("target_axes"), static_cast<GLsizei>(axes.size()), GL_FALSE, &axes[0][0][0]);
    gl.Uniform4fv(visibility_program.uniform("target_window"), static_cast<GLsizei>(windows.size()), &windows[0][0]);
  }
  struct Binding {
    const char* name;
    GLenum kind;
    GLuint texture;
  };
  const Binding bindings[] = {{"surface_position", GL_TEXTURE_2D, *surface_position},
                              {"surface_normal", GL_TEXTURE_2D, *surface_normal},
                              {"occluder_face", GL_TEXTURE_2D_ARRAY, buffers->occluder.id.texture},
                              {"occluder_depth", GL_TEXTURE_2D_ARRAY, buffers->occluder.depth.texture},
                              {"penumbra_facet", GL_TEXTURE_2D_ARRAY, buffers->penumbra.id.texture},
                              {"penumbra_depth", GL_TEXTURE_2D_ARRAY, buffers->penumbra.depth.texture},
                              {"last_depth", GL_TEXTURE_2D_ARRAY, buffers->last.texture},
                              {"above_facet", GL_TEXTURE_2D_ARRAY, buffers->umbra_above.id.texture},
                              {"above_depth", GL_TEXTURE_2D_ARRAY, buffers->umbra_above.depth.texture},
                              {"below_facet", GL_TEXTURE_2D_ARRAY, buffers->umbra_below.id.texture},
                              {"below_depth", GL_TEXTURE_2D_ARRAY, buffers->umbra_below.depth.texture},
                              {"records", GL_TEXTURE_BUFFER, record_texture}};
  int unit = 0;
  for (const Binding& b : bindings) {
    bind(unit, b.kind, b.texture);
    gl.Uniform1i(visibility_program.uniform(b.name), unit++);
  }
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.Finish();
  std::vector<float> out(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.ReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, out.data());
  gl.ActiveTexture(GL_TEXTURE0);
  return out;
}

DBufferFrame DBuffer::Impl::render(const DiskLight& light, const DBufferOptions& options) {
  DBufferFrame frame;
  StageClock clock;
  Plan plan{detail::LightSpace(light, scale), {}, {}, {}, {}, {}};
  plan.axes = light_matrix(plan.space.axes);
  plan.offset = glm::vec3(plan.space.to_light(origin));
  find_geometry(light, options, plan, clock, frame.counts);

  const int count = std::max(1, static_cast<int>(plan.targets.size()));
  if (!buffers || buffers->size != options.size || buffers->count != count)
    buffers = std::make_unique<Buffers>(gl, options.size, count);
  upload(plan);
  gl.Finish();
  clock.finish("upload");

  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, options.size, options.size);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  draw_occluders(plan);
  gl::require_complete_framebuffer(gl, "drawing the D-buffer");
  gl.Finish();
  clock.finish("occluders");
  draw_entries(plan, buffers->penumbra, plan.geometry.penumbra, penumbra_vertices, Against::kFirst);
  draw_entries(plan, buffers->umbra_above, plan.geometry.umbra, umbra_vertices, Against::kLast);
  draw_entries(plan, buffers->umbra_below, plan.geometry.umbra, umbra_vertices, Against::kBehindLast);
  gl.Finish();
  clock.finish("entries");
  frame.visibility = shade(plan);
  clock.finish("visibility");
  gl::require_no_error(gl, "rendering the D-buffer");
  frame.stages = clock.stages();
  return frame;
}

DBuffer::DBuffer(gl::Context& context, const Scene& scene, const RayScene& rays) {
  context.make_current();
  impl_ = std::make_unique<Impl>(context, scene, rays);
}

DBuffer::~DBuffer() {
  if (impl_) impl_->context.make_current();
}

void DBuffer::set_surface(const SurfaceBuffer& surface) {
  impl_->context.make_current();
  impl_->set_surface(surface);
}

DBufferFrame DBuffer::render(const DiskLight& light, const DBufferOptions& options) {
  if (options.size < 16 || options.size > 8192)
    throw UsageError("D-buffer size must lie in 16 to 8192 texels, not " + std::to_string(options.size));
  impl_->context.make_current();
  return impl_->render(light, options);
}

}  // namespace penumbra
