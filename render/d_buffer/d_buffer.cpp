#include "render/d_buffer/d_buffer.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/vertex_rings.h"
#include "penumbra/volumes/volumes.h"
#include "render/d_buffer/image_side.h"
#include "render/d_buffer/passes.h"
#include "render/d_buffer/pictures.h"
#include "render/gl/state_scope.h"
#include "render/receivers/occluding_casters.h"
#include "render/support/background.h"

namespace penumbra {
namespace {

using gl::Object;

/// Facets up to this part of the target's width are narrow.
constexpr double kNarrow = 1.0 / 32.0;

struct Caster {
  const TriangleMesh* mesh;
  VertexRings rings;
  detail::CasterPlanes planes;
  bool idle = false;  ///< hides nothing from any receiver under this frame's light
};

glm::mat3 light_matrix(const LightFrame& axes) {
  return glm::transpose(glm::mat3(glm::vec3(axes.u), glm::vec3(axes.v), glm::vec3(axes.w)));
}

}  // namespace

struct DBuffer::Impl {
  Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_);

  void set_surface(const Receivers& surface);
  DBufferFrame render(const DiskLight& light, const DBufferOptions& options, const Progress& progress);
  std::vector<TexturePicture> textures() const;

  /// What the light alone says of where one caster's shadow is bounded.
  struct Outline {
    Classification classes;
    Silhouettes silhouettes;
    Supports supports;  ///< facets, not linked yet
    std::vector<GapFace> gaps;
  };
  /// The same with what the image's receivers ask for.
  struct Boundary {
    const Outline* outline;
    Supports supports;
    detail::FacetReach reach;
  };
  /// What one frame knows before anything is drawn.
  struct Plan {
    detail::LightSpace space;
    glm::mat3 axes;  ///< scene frame → light's frame
    glm::vec3 offset;
    std::vector<detail::Target> targets{};
    detail::FootprintOptions footprint{};
    detail::ReceiverGrid receivers{};
    std::vector<Boundary> boundaries{};  ///< one per caster
    detail::EntryGeometry geometry{};
    detail::DBufferView view() const { return {targets, axes, offset, space.radius}; }
    detail::EntryFootprints footprints(const Caster& caster, const Boundary& b) const {
      return {*caster.mesh, space, b.supports, footprint};
    }
  };
  void find_idle(const DiskLight& light);
  void choose_view(const DBufferOptions& options, Plan& plan) const;
  void find_outlines(const DiskLight& light, StageClock& clock);
  void find_boundaries(const DiskLight& light, Plan& plan, StageClock& clock) const;
  void find_geometry(Plan& plan) const;
  static Counts count(const Plan& plan);
  detail::UvBounds caster_window(const detail::LightSpace& space, double far_weight) const;
  double far_weight(const detail::LightSpace& space) const;
  void find_entries(const DiskLight& light, Plan& plan, StageClock& clock);
  void prepare_layers(const Plan& plan, const DBufferOptions& options);

  gl::Context& context;
  const gl::Functions& gl;
  const Scene& scene;
  const RayScene& rays;
  Vec3 origin;  ///< scene frame: (world - origin) · scale, about the casters
  double scale;
  std::vector<Caster> casters;
  std::vector<Outline> outlines;      ///< one per caster
  std::optional<DiskLight> outlined;  ///< the light that these are for

  detail::DBufferPasses passes;
  detail::DBufferShading shading;
  Object framebuffer;
  std::unique_ptr<detail::DBufferLayers> layers;
};

DBuffer::Impl::Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_)
    : context(context_),
      gl(context_.functions()),
      scene(scene_),
      rays(rays_),
      scale(rays_.frame().scale),
      passes(gl),
      shading(gl),
      framebuffer(gl, Object::Kind::kFramebuffer) {
  const Bounds bounds = scene.caster_bounds();
  origin = bounds.empty() ? Vec3(0.0) : bounds.center();
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
      casters.push_back({&mesh, VertexRings(mesh), detail::CasterPlanes(mesh, origin, scale)});
    }
    first_face += static_cast<std::uint32_t>(mesh.triangles().size());
  }
  passes.upload_casters(std::move(points), std::move(indices), std::move(ranges));
  gl::require_no_error(gl, "uploading casters");
}

void DBuffer::Impl::set_surface(const Receivers& surface) {
  std::vector<std::uint32_t> first_face{0};
  for (const SceneObject& object : scene.objects)
    first_face.push_back(first_face.back() + static_cast<std::uint32_t>(object.mesh.triangles().size()));
  std::vector<glm::vec4> positions(surface.size(), glm::vec4(0.0f));
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (!surface.is_present(i)) continue;
    const std::uint32_t face =
        first_face[static_cast<std::size_t>(surface.objects[i])] + surface.faces[i] + 1;
    positions[i] = glm::vec4(glm::vec3((surface.points[i] - origin) * scale), static_cast<float>(face));
  }
  const detail::ReceiverCloud receivers(positions);
  for (Caster& caster : casters) caster.planes.set_receivers(receivers);
  shading.set_surface(surface, std::move(positions), rays);
  gl::require_no_error(gl, "uploading the surface buffer");
}

/// Casters that hide nothing from the image take no part, nor do they widen the target. Receivers on a floor
/// are rounded to either side of it, by less than what rays start above it.
void DBuffer::Impl::find_idle(const DiskLight& light) {
  std::vector<bool> idle;
  for (Caster& caster : casters) {
    const bool is_idle = caster.planes.cannot_occlude(light, 0.5 * kRayOffset);
    if (is_idle != caster.idle) outlined.reset();
    caster.idle = is_idle;
    idle.push_back(is_idle);
  }
  passes.set_idle(idle);
}

double DBuffer::Impl::far_weight(const detail::LightSpace& space) const {
  double farthest = 0.0;
  for (const SceneObject& object : scene.objects) {
    const Bounds& b = object.mesh.bounds();
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
detail::UvBounds DBuffer::Impl::caster_window(const detail::LightSpace& space, double far) const {
  detail::UvBounds window;
  for (const Caster& caster : casters) {
    if (caster.idle) continue;
    std::size_t behind = 0;
    for (const Vec3& world : caster.mesh->positions()) {
      const Vec3 p = space.to_light(world);
      if (p.z < detail::kNearDepth) {
        ++behind;
        continue;
      }
      const glm::dvec2 uv = glm::dvec2(p.x, p.y) / p.z;
      const double reach = space.radius * std::max(0.0, 1.0 / p.z - far);
      window.add(uv - reach);
      window.add(uv + reach);
    }
    if (behind > 0 && behind < caster.mesh->positions().size()) return {glm::dvec2(-1e9), glm::dvec2(1e9)};
  }
  return window;
}

/// Targets, and what of them will be read. Which entries a receiver reads is known beforehand only where a
/// ray tells whether it sees the light's center; and where the furthest entries are kept, far ones count for
/// all.
void DBuffer::Impl::choose_view(const DBufferOptions& options, Plan& plan) const {
  const double far = far_weight(plan.space);
  const detail::UvBounds window = caster_window(plan.space, far);
  plan.targets = detail::choose_targets(window.low, window.high, options.size);
  if (plan.targets.empty()) return;
  const bool hemicube = plan.targets.size() > 1;
  const auto& w = plan.targets[0].window;
  const double width = std::max(w[1] - w[0], w[3] - w[2]);
  plan.footprint = {detail::kNearDepth, far, width / options.size, hemicube, width * kNarrow};
  if (!hemicube && options.center == CenterTest::kRay && options.conflict == Conflict::kNearest)
    plan.receivers = shading.receiver_grid(plan.view(), options.size);
}

/// Classes to facets, stage by stage over all casters; nothing where the light is that of the last frame.
void DBuffer::Impl::find_outlines(const DiskLight& light, StageClock& clock) {
  if (outlined == light) return;
  outlined.reset();
  outlines.assign(casters.size(), {});
  const auto stage = [&](const char* name, const auto& body) {
    for (std::size_t i = 0; i < casters.size(); ++i)
      if (!casters[i].idle) body(*casters[i].mesh, outlines[i]);
    clock.finish(name);
  };
  stage("classify", [&](const TriangleMesh& m, Outline& o) { o.classes = classify_faces(m, light); });
  stage("silhouette",
        [&](const TriangleMesh& m, Outline& o) { o.silhouettes = find_silhouettes(m, o.classes); });
  stage("supports", [&](const TriangleMesh& m, Outline& o) {
    o.supports.facets = find_support_facets(m, light, o.silhouettes);
    o.gaps = find_gap_faces(m, light, o.classes, o.supports);
  });
  outlined = light;
}

/// Most facets of a fine mesh are hidden; only where others end is it asked how the boundary goes on.
void DBuffer::Impl::find_boundaries(const DiskLight& light, Plan& plan, StageClock& clock) const {
  for (const Outline& o : outlines) plan.boundaries.push_back({&o, o.supports, {}});
  const auto stage = [&](const char* name, const auto& body) {
    for (std::size_t i = 0; i < casters.size(); ++i)
      if (!casters[i].idle) body(casters[i], plan.boundaries[i]);
    clock.finish(name);
  };
  stage("reach", [&](const Caster& c, Boundary& b) {
    const auto probes =
        detail::count_facet_probes(plan.footprints(c, b), b.supports, b.outline->gaps, plan.receivers);
    detail::find_facet_reach(*c.mesh, light, b.supports, probes, rays, b.reach);
  });
  stage("corners", [&](const Caster& c, Boundary& b) {
    std::vector<char> in_sight(b.reach.facets.size());
    for (std::size_t i = 0; i < in_sight.size(); ++i) in_sight[i] = b.reach.facets[i] > 0.0f;
    link_support_facets(*c.mesh, c.rings, light, in_sight, b.supports);
    const auto probes = detail::count_cone_probes(plan.footprints(c, b), b.supports, plan.receivers);
    detail::find_cone_reach(*c.mesh, light, b.supports, probes, rays, b.reach);
  });
}

void DBuffer::Impl::find_geometry(Plan& plan) const {
  if (plan.targets.empty()) return;
  for (std::size_t i = 0; i < casters.size(); ++i) {
    if (casters[i].idle) continue;
    const Boundary& b = plan.boundaries[i];
    const detail::EntryFootprints footprints = plan.footprints(casters[i], b);
    detail::append_entry_geometry({footprints, b.supports, b.outline->gaps, b.reach, plan.receivers},
                                  plan.geometry);
  }
  detail::sort_by_geometry(plan.geometry);
}

Counts DBuffer::Impl::count(const Plan& plan) {
  std::size_t faces = 0, mixed = 0, umbra = 0, penumbra = 0, band = 0, facets = 0, cones = 0;
  for (const Boundary& b : plan.boundaries) {
    faces += b.outline->classes.faces.size();
    mixed += b.outline->classes.mixed;
    umbra += b.outline->silhouettes.umbra.size();
    penumbra += b.outline->silhouettes.penumbra.size();
    band += b.outline->silhouettes.band.size();
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

/// All that is drawn but occluders.
void DBuffer::Impl::find_entries(const DiskLight& light, Plan& plan, StageClock& clock) {
  find_outlines(light, clock);
  find_boundaries(light, plan, clock);
  find_geometry(plan);
  clock.finish("facets");
}

/// Textures, and the state that drawing into them needs.
void DBuffer::Impl::prepare_layers(const Plan& plan, const DBufferOptions& options) {
  const int count = std::max(1, static_cast<int>(plan.targets.size()));
  if (!layers || layers->size != options.size || layers->count != count ||
      layers->entries != options.entries) {
    layers.reset();  // before the new ones take memory
    layers = std::make_unique<detail::DBufferLayers>(gl, options.size, count, options.entries);
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, options.size, options.size);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

/// Occluders are drawn while entries are found, and image tiles chosen while entries are drawn: OpenGL leaves
/// a core idle for most of its time.
DBufferFrame DBuffer::Impl::render(const DiskLight& light, const DBufferOptions& options,
                                   const Progress& progress) {
  DBufferFrame frame;
  StageClock clock;
  const detail::LightSpace space(light, scale);
  Plan plan{space, light_matrix(space.axes), glm::vec3(space.to_light(origin))};
  if (options.center == CenterTest::kRay) shading.trace_center(light);
  clock.finish("center");
  find_idle(light);
  choose_view(options, plan);
  clock.finish("receivers");
  {
    detail::Background finding(rays.arena(), [&] { find_entries(light, plan, clock); });
    prepare_layers(plan, options);
    passes.draw_occluders(plan.targets, plan.axes, plan.offset, plan.receivers, *layers, options);
    gl.Flush();
    finding.wait();
  }
  frame.counts = count(plan);
  gl.Finish();
  clock.finish("occluders");
  report(progress, 0.3);
  std::vector<glm::vec2> tiles;
  {
    detail::Background choosing(
        rays.arena(), [&] { tiles = shading.tiles(plan.view(), plan.receivers, plan.geometry, options); });
    passes.upload_entries(plan.geometry);
    passes.draw_entries(plan.targets, *layers, options);
    gl.Finish();
  }
  clock.finish("entries");
  report(progress, 0.6);
  frame.visibility = shading.shade(light, plan.view(), tiles, *layers, passes.records(), options);
  clock.finish("visibility");
  gl::require_no_error(gl, "rendering the D-buffer");
  const auto idle = static_cast<std::uint64_t>(std::ranges::count_if(casters, &Caster::idle));
  frame.counts.push_back({"casters_that_cannot_occlude", idle});
  frame.counts.push_back({"sampled_pixels", shading.sampled()});
  frame.counts.push_back({"buffer_size", static_cast<std::uint64_t>(options.size)});
  frame.counts.push_back({"buffer_bytes", layers->bytes()});
  frame.stages = clock.stages();
  return frame;
}

std::vector<TexturePicture> DBuffer::Impl::textures() const {
  if (!layers) return {};
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  return detail::pictures_of(gl, *layers);
}

DBuffer::DBuffer(gl::Context& context, const Scene& scene, const RayScene& rays) {
  context.make_current();
  const gl::StateScope scope(context.functions());
  impl_ = std::make_unique<Impl>(context, scene, rays);
}

DBuffer::~DBuffer() {
  if (impl_) impl_->context.make_current();
}

void DBuffer::set_surface(const Receivers& surface) {
  impl_->context.make_current();
  const gl::StateScope scope(impl_->gl);
  impl_->set_surface(surface);
}

int d_buffer_size_for(int width, int height) {
  constexpr double kStep = 64.0;
  const double side = std::sqrt(static_cast<double>(width) * height);
  return static_cast<int>(std::clamp(std::ceil(side / kStep) * kStep, 512.0, 4096.0));
}

DBufferFrame DBuffer::render(const DiskLight& light, const DBufferOptions& wanted, const Progress& progress) {
  DBufferOptions options = wanted;
  if (options.size == 0) options.size = impl_->shading.automatic_size();
  if (options.size < 16 || options.size > 8192)
    throw UsageError("D-buffer size must lie in 16 to 8192 texels (0: by the image's), not " +
                     std::to_string(options.size));
  if (options.entries < 1 || options.entries > 2)
    throw UsageError("D-buffer entries must be 1 or 2, not " + std::to_string(options.entries));
  if (options.entries == 2 &&
      (options.contents != DBufferContents::kEdge || options.conflict != Conflict::kNearest))
    throw UsageError("two D-buffer entries need --dbuffer edge and --conflict nearest");
  if (!impl_->shading.has_surface()) throw UsageError("DBuffer::set_surface has to come before render");
  impl_->context.make_current();
  const gl::StateScope scope(impl_->gl);
  return impl_->render(light, options, progress);
}

void DBuffer::forget_light() {
  impl_->outlined.reset();
}

std::vector<TexturePicture> DBuffer::textures() const {
  impl_->context.make_current();
  const gl::StateScope scope(impl_->gl);
  return impl_->textures();
}

}  // namespace penumbra
