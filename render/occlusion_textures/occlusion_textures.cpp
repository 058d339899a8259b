#include "render/occlusion_textures/occlusion_textures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <string>

#include "penumbra/mesh/error.h"
#include "render/gl/state_scope.h"
#include "render/light/light_integrals.h"
#include "render/occlusion_textures/lookup.h"
#include "render/occlusion_textures/occlusion_textures_method.h"

namespace penumbra {
namespace {

// Speed (occlusion_bench).

/// Pixels a side of the tiles that are looked up together.
constexpr int kTile = 16;
/// Rows of tiles between two calls of the progress callback, which wait for all threads.
constexpr int kRowsAtOnce = 12;
static_assert(kTile * kTile <= detail::SliceReceivers::kMost);

void require_valid(const OcclusionOptions& o) {
  const std::vector<OptionSchema> schema = occlusion_options();
  require_allowed(schema, "slices", static_cast<std::uint64_t>(o.slices));
  require_allowed(schema, "texture-size", static_cast<std::uint64_t>(o.texture_size));
  const bool perspective = o.cop_offset && !std::isinf(*o.cop_offset);
  if (o.cop_offset)
    require_allowed(schema, "cop-offset",
                    perspective ? OptionValue(*o.cop_offset) : OptionValue("orthographic"));
}

}  // namespace

struct OcclusionTextures::Impl {
  Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_);
  OcclusionFrame render(const AreaLight& light, const Receivers& surface, const OcclusionOptions& options,
                        const Progress& progress);

  /// What one frame knows before anything is drawn.
  struct Plan {
    std::vector<detail::CasterExtent> extents;  ///< one per caster
    detail::SliceFrustum frustum;
    std::vector<detail::CasterDrawing> drawings;  ///< one per caster
    bool nothing_casts = false;
  };
  Plan plan(const detail::SliceSpace& space, const OcclusionOptions& options) const;
  detail::DepthRange range_to_slice(const detail::DepthRange& of_casters, const detail::SliceSpace& space,
                                    const OcclusionOptions& options) const;
  void look_up(const detail::SliceSpace& space, const Receivers& surface,
               const detail::OcclusionLookup* lookup, const Progress& progress,
               std::vector<float>& visibility) const;

  gl::Context& context;
  const Scene& scene;
  const RayScene& rays;
  /// The caster frame, in which points are uploaded: (world - origin) · scale.
  Vec3 origin;
  double scale;
  std::vector<const TriangleMesh*> casters;
  std::vector<double> thickness;  ///< one per caster
  std::unique_ptr<detail::OcclusionMasks> masks;
};

OcclusionTextures::Impl::Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_)
    : context(context_), scene(scene_), rays(rays_), scale(rays_.frame().scale) {
  const Bounds bounds = scene.caster_bounds();
  origin = bounds.empty() ? Vec3(0.0) : bounds.center();
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> indices;
  std::vector<detail::MaskRange> ranges;
  for (const SceneObject& object : scene.objects) {
    if (!object.casts || object.mesh.empty()) continue;
    const auto first_index = static_cast<std::uint32_t>(indices.size());
    const auto first_point = static_cast<std::uint32_t>(points.size());
    for (const Vec3& p : object.mesh.positions()) points.push_back(glm::vec3((p - origin) * scale));
    for (const IndexedTriangle& t : object.mesh.triangles())
      for (std::uint32_t v : t) indices.push_back(first_point + v);
    ranges.push_back({first_index, static_cast<std::uint32_t>(indices.size()) - first_index});
    casters.push_back(&object.mesh);
    thickness.push_back(detail::mean_thickness(object.mesh));
  }
  masks = std::make_unique<detail::OcclusionMasks>(context.functions(), points, indices, std::move(ranges));
  gl::require_no_error(context.functions(), "uploading casters");
}

detail::DepthRange OcclusionTextures::Impl::range_to_slice(const detail::DepthRange& of_casters,
                                                           const detail::SliceSpace& space,
                                                           const OcclusionOptions& options) const {
  if (options.range == SliceRange::kCasters) return of_casters;
  detail::DepthRange all = of_casters, others;
  for (const SceneObject& object : scene.objects)
    for (const Vec3& p : object.mesh.positions())
      (object.casts ? all : others).add(std::max(space.to_light(p).z, detail::kNearSlice));
  all.add(others);
  const double slice = (all.far - all.near) / options.slices;
  const bool contact = others.near < of_casters.far + slice;
  return options.range == SliceRange::kAuto && contact ? of_casters : all;
}

OcclusionTextures::Impl::Plan OcclusionTextures::Impl::plan(const detail::SliceSpace& space,
                                                            const OcclusionOptions& options) const {
  Plan plan;
  detail::DepthRange depth;
  for (const TriangleMesh* mesh : casters) {
    plan.extents.push_back(detail::caster_extent(*mesh, space));
    depth.add(plan.extents.back().depth);
  }
  plan.nothing_casts = depth.empty();
  if (plan.nothing_casts) return plan;
  plan.frustum = detail::fit_frustum(plan.extents, range_to_slice(depth, space, options), space, options);
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const bool leaks = options.thin_fix == ThinFix::kAuto &&
                       detail::may_leak(thickness[i], plan.extents[i], space, plan.frustum);
    const bool solid = casters[i]->is_closed() && !plan.extents[i].cut;
    plan.drawings.push_back({.fills_next = leaks || options.thin_fix == ThinFix::kOn,
                             .front_only = solid && options.faces == SliceFaces::kFront});
  }
  return plan;
}

/// `lookup`: none where nothing casts.
void OcclusionTextures::Impl::look_up(const detail::SliceSpace& space, const Receivers& surface,
                                      const detail::OcclusionLookup* lookup, const Progress& progress,
                                      std::vector<float>& visibility) const {
  visibility.assign(surface.size(), 1.0f);
  using detail::SliceReceivers;
  // Neighbors in both directions look at the same texels.
  const auto tile = [&](int left, int top) {
    SliceReceivers receivers;
    std::array<std::size_t, SliceReceivers::kMost> pixels;
    for (int y = top; y < std::min(top + kTile, surface.height); ++y)
      for (int x = left; x < std::min(left + kTile, surface.width); ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(surface.width) +
                              static_cast<std::size_t>(x);
        if (!surface.is_present(i)) continue;
        const Vec3 p = space.to_light(surface.points[i]);
        const double above = fraction_above_horizon(space.light, surface.points[i], surface.normals[i]);
        visibility[i] = static_cast<float>(above);
        if (!lookup || !(p.z > 0.0) || !(above > 0.0)) continue;
        pixels[receivers.count] = i;
        receivers.add(p, above);
      }
    if (lookup) lookup->look_up(receivers);
    for (std::size_t k = 0; k < receivers.count; ++k)
      visibility[pixels[k]] = static_cast<float>(receivers.visibility[k]);
  };
  const int rows = (surface.height + kTile - 1) / kTile;
  for (int first = 0; first < rows; first += kRowsAtOnce) {
    report(progress, static_cast<double>(first) / rows);
    rays.arena().execute([&] {
      tbb::parallel_for(first, std::min(rows, first + kRowsAtOnce), [&](int row) {
        for (int left = 0; left < surface.width; left += kTile) tile(left, row * kTile);
      });
    });
  }
}

OcclusionFrame OcclusionTextures::Impl::render(const AreaLight& light, const Receivers& surface,
                                               const OcclusionOptions& options, const Progress& progress) {
  OcclusionFrame frame;
  StageClock clock;
  const detail::SliceSpace space(light, scale);
  const Plan plan = this->plan(space, options);
  clock.finish("frustum");
  std::uint64_t used = 0, bytes = 0;
  std::unique_ptr<detail::OcclusionLookup> lookup;
  if (!plan.nothing_casts) {
    const LightFrame& f = space.light.axes;
    const glm::mat3 axes(glm::transpose(glm::dmat3(f.u, f.v, f.w)));
    auto slices =
        masks->draw(plan.frustum, axes, glm::vec3(space.to_light(origin)), plan.drawings, options, clock);
    report(progress, 0.0);
    rays.arena().execute(
        [&] { lookup = detail::make_occlusion_lookup(slices, plan.frustum, space, options); });
    clock.finish("prefilter");
    used = static_cast<std::uint64_t>(
        std::ranges::count_if(slices, [](const auto& texels) { return !texels.empty(); }));
    bytes = lookup->bytes();
    const auto thin = std::ranges::count_if(plan.drawings, &detail::CasterDrawing::fills_next);
    frame.counts.push_back({"thin_casters", static_cast<std::uint64_t>(thin)});
    frame.counts.push_back({"slice_thickness", plan.frustum.thickness / space.scale});
    if (plan.frustum.narrowing > 0.0)
      frame.counts.push_back({"cop_offset", 1.0 / (plan.frustum.narrowing * space.scale)});
    else
      frame.counts.push_back({"cop_offset", "orthographic"});
    for (std::size_t i = 0; i < slices.size(); ++i)
      if (!slices[i].empty())
        frame.textures.push_back(
            {"slice " + std::to_string(i + 1), options.texture_size, std::move(slices[i])});
  }
  frame.counts.push_back({"casters", casters.size()});
  frame.counts.push_back({"slices_in_use", used});
  frame.counts.push_back({"texture_bytes", bytes});
  look_up(space, surface, lookup.get(), progress, frame.visibility);
  clock.finish("visibility");
  gl::require_no_error(context.functions(), "rendering occlusion textures");
  frame.stages = clock.stages();
  return frame;
}

std::span<const NamedValue<OcclusionFilter>> occlusion_filters() {
  static constexpr NamedValue<OcclusionFilter> kNames[] = {{OcclusionFilter::kMipmap, "mipmap"},
                                                           {OcclusionFilter::kNBuffer, "nbuffer"},
                                                           {OcclusionFilter::kSummedArea, "sat"}};
  return kNames;
}

std::span<const NamedValue<OcclusionCombine>> occlusion_combines() {
  static constexpr NamedValue<OcclusionCombine> kNames[] = {{OcclusionCombine::kProduct, "product"},
                                                            {OcclusionCombine::kSum, "sum"},
                                                            {OcclusionCombine::kMaximum, "maximum"}};
  return kNames;
}

std::span<const NamedValue<OcclusionKernel>> occlusion_kernels() {
  static constexpr NamedValue<OcclusionKernel> kNames[] = {{OcclusionKernel::kBox, "box"},
                                                           {OcclusionKernel::kDisk, "disk"}};
  return kNames;
}

std::span<const NamedValue<ThinFix>> thin_fixes() {
  static constexpr NamedValue<ThinFix> kNames[] = {
      {ThinFix::kOff, "off"}, {ThinFix::kOn, "on"}, {ThinFix::kAuto, "auto"}};
  return kNames;
}

std::span<const NamedValue<SliceRange>> slice_ranges() {
  static constexpr NamedValue<SliceRange> kNames[] = {
      {SliceRange::kScene, "scene"}, {SliceRange::kCasters, "casters"}, {SliceRange::kAuto, "auto"}};
  return kNames;
}

std::span<const NamedValue<SliceCoverage>> slice_coverages() {
  static constexpr NamedValue<SliceCoverage> kNames[] = {{SliceCoverage::kBinary, "binary"},
                                                         {SliceCoverage::kArea, "area"}};
  return kNames;
}

std::span<const NamedValue<SliceFaces>> slice_faces() {
  static constexpr NamedValue<SliceFaces> kNames[] = {{SliceFaces::kAll, "all"},
                                                      {SliceFaces::kFront, "front"}};
  return kNames;
}

OcclusionTextures::OcclusionTextures(gl::Context& context, const Scene& scene, const RayScene& rays) {
  context.make_current();
  const gl::StateScope scope(context.functions());
  impl_ = std::make_unique<Impl>(context, scene, rays);
}

OcclusionTextures::~OcclusionTextures() {
  try {
    if (impl_) impl_->context.make_current();
  } catch (const Error&) {  // another thread has the context: what it holds goes with it
  }
}

OcclusionFrame OcclusionTextures::render(const AreaLight& light, const Receivers& surface,
                                         const OcclusionOptions& options, const Progress& progress) {
  require_valid(options);
  impl_->context.make_current();
  const gl::StateScope scope(impl_->context.functions());
  return impl_->render(light, surface, options, progress);
}

}  // namespace penumbra
