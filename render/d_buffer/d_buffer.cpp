#include "render/d_buffer/d_buffer.h"

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/error.h"
#include "render/d_buffer/boundaries.h"
#include "render/d_buffer/d_buffer_method.h"
#include "render/d_buffer/fill_passes.h"
#include "render/d_buffer/pictures.h"
#include "render/d_buffer/view/casters.h"
#include "render/d_buffer/view/view.h"
#include "render/d_buffer/visibility_pass.h"
#include "render/gl/state_scope.h"
#include "render/receivers/occluding_casters.h"
#include "render/support/background.h"

namespace penumbra {
namespace {

/// Whether it is known before drawing which entries a receiver reads: a ray has told whether it sees the
/// light's center, and no entry counts that is farther away than the receiver. The grid of receivers has a
/// single target.
bool reads_are_known(const detail::DBufferView& view, const DBufferOptions& options) {
  return view.targets.size() == 1 && options.center == CenterTest::kRay &&
         options.conflict == Conflict::kNearest;
}

void require_valid(const DBufferOptions& o) {
  const std::vector<OptionSchema> schema = d_buffer_options();
  require_allowed(schema, "dbuffer-size", static_cast<std::uint64_t>(o.size));
  require_allowed(schema, "dbuffer-entries", static_cast<std::uint64_t>(o.entries));
  if (o.entries == 2 && (o.contents != DBufferContents::kEdge || o.conflict != Conflict::kNearest))
    throw UsageError(
        "option dbuffer-entries: 2 needs option dbuffer edge and option conflict nearest; give 1 or change "
        "these");
}

}  // namespace

struct DBuffer::Impl {
  Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_);

  void set_surface(const Receivers& surface);
  DBufferFrame render(const CircularLight& light, const DBufferOptions& options, const Progress& progress);
  std::vector<TexturePicture> textures() const;

  void find_casters_that_cannot_occlude(const CircularLight& light);
  void prepare_layers(const detail::DBufferView& view, const DBufferOptions& options);

  gl::Context& context;
  const gl::Functions& gl;
  const Scene& scene;
  const RayScene& rays;
  std::vector<detail::DBufferCaster> casters;
  detail::Outlines outlines;

  detail::FillPasses passes;
  detail::VisibilityPass shading;
  gl::Object framebuffer;
  std::unique_ptr<detail::DBufferLayers> layers;
};

DBuffer::Impl::Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_)
    : context(context_),
      gl(context_.functions()),
      scene(scene_),
      rays(rays_),
      casters(detail::find_casters(scene_)),
      passes(gl),
      shading(gl),
      framebuffer(gl, gl::Object::Kind::kFramebuffer) {
  passes.upload_casters(detail::caster_triangles(scene));
  gl::require_no_error(gl, "uploading casters");
}

void DBuffer::Impl::set_surface(const Receivers& surface) {
  shading.set_surface(surface, detail::first_faces(scene), rays);
  gl::require_no_error(gl, "uploading the surface buffer");
}

void DBuffer::Impl::find_casters_that_cannot_occlude(const CircularLight& light) {
  const std::vector<char> flags = detail::find_casters_that_cannot_occlude(scene, light, shading.surface());
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const bool cannot_occlude = flags[casters[i].object] != 0;
    if (cannot_occlude != casters[i].cannot_occlude) outlines.forget();
    casters[i].cannot_occlude = cannot_occlude;
    passes.casters().ranges[i].cannot_occlude = cannot_occlude;
  }
}

/// Textures, and the state that drawing into them needs.
void DBuffer::Impl::prepare_layers(const detail::DBufferView& view, const DBufferOptions& options) {
  const int count = std::max(1, static_cast<int>(view.targets.size()));
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

/// Occluders are drawn while boundaries are found, and tiles of the image chosen while entries are drawn:
/// OpenGL leaves a core idle for most of its time.
DBufferFrame DBuffer::Impl::render(const CircularLight& light, const DBufferOptions& options,
                                   const Progress& progress) {
  DBufferFrame frame;
  StageClock clock;
  const Receivers surface = shading.surface();
  if (options.center == CenterTest::kRay) shading.trace_center(light);
  clock.finish("center");
  find_casters_that_cannot_occlude(light);
  const detail::LightSpace space(light, shading.middle().middle, shading.middle().least_depth());
  const detail::ReceiversInLight placed(surface, space);
  const detail::CastersInLight seen = detail::casters_in_light(passes.casters(), space);
  const detail::DBufferView view = detail::choose_view(space, passes.casters(), seen, placed, options.size);
  shading.place_receivers(placed, view);
  passes.upload_points(detail::drawn_points(seen, view.space));
  const detail::ReceiverGrid receivers =
      reads_are_known(view, options) ? shading.receiver_grid(view, options.size) : detail::ReceiverGrid();
  clock.finish("receivers");

  detail::EntryGeometry geometry;
  {
    detail::Background finding(rays.arena(), [&] {
      outlines.find(casters, light, clock);
      const detail::BoundarySource source{casters, light, view, receivers, rays};
      const auto boundaries = detail::find_boundaries(source, outlines.all(), clock);
      geometry = detail::find_geometry(source, boundaries);
      frame.counts = detail::count_boundaries(boundaries);
      clock.finish("facets");
    });
    prepare_layers(view, options);
    passes.draw_occluders(view, receivers, *layers, options);
    gl.Flush();
    finding.wait();
  }
  gl.Finish();
  clock.finish("occluders");
  report(progress, 0.3);

  std::vector<glm::vec2> tiles;
  {
    detail::Background choosing(rays.arena(),
                                [&] { tiles = shading.tiles(view, receivers, geometry, options); });
    passes.upload_entries(geometry);
    passes.draw_entries(view, *layers, options);
    gl.Finish();
  }
  clock.finish("entries");
  report(progress, 0.6);

  frame.visibility = shading.shade(light, view, tiles, *layers, {geometry, passes.records()}, options);
  clock.finish("visibility");
  gl::require_no_error(gl, "rendering the D-buffer");
  const auto left_out = std::ranges::count_if(casters, &detail::DBufferCaster::cannot_occlude);
  frame.counts.push_back({"targets", view.targets.size()});
  frame.counts.push_back({"entry_triangles", (geometry.penumbra.size() + geometry.umbra.size()) / 3});
  frame.counts.push_back({"casters_that_cannot_occlude", static_cast<std::uint64_t>(left_out)});
  frame.counts.push_back({"sampled_pixels", shading.resampled()});
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
  try {
    if (impl_) impl_->context.make_current();
  } catch (const Error&) {  // another thread has the context: what it holds goes with it
  }
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

DBufferFrame DBuffer::render(const CircularLight& light, const DBufferOptions& wanted,
                             const Progress& progress) {
  DBufferOptions options = wanted;
  if (options.size == 0) options.size = impl_->shading.automatic_size();
  require_valid(options);
  if (!impl_->shading.has_surface()) throw UsageError("DBuffer::set_surface has to come before render");
  impl_->context.make_current();
  const gl::StateScope scope(impl_->gl);
  return impl_->render(light, options, progress);
}

void DBuffer::forget_light() {
  impl_->outlines.forget();
}

std::vector<TexturePicture> DBuffer::textures() const {
  impl_->context.make_current();
  const gl::StateScope scope(impl_->gl);
  return impl_->textures();
}

}  // namespace penumbra
