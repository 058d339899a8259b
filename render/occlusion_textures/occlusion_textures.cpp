#include "render/occlusion_textures/occlusion_textures.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "penumbra/mesh/error.h"
#include "render/gl/state_scope.h"
#include "render/light/light_integrals.h"
#include "render/occlusion_textures/lookup.h"
#include "render/occlusion_textures/occlusion_textures_method.h"
#include "render/receivers/receiver_middle.h"

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
  /// The receivers of one frame, with their local coordinates: not numbers where nothing is seen.
  struct Placed {
    const Receivers& surface;
    const detail::SliceSpace& space;
    std::vector<Vec3> places;
  };
  Placed place(const Receivers& surface, const detail::SliceSpace& space) const;
  Plan plan(const Placed& receivers, const OcclusionOptions& options) const;
  detail::DepthRange range_to_slice(const std::vector<detail::CasterExtent>& extents,
                                    const detail::SeenRegion& region, const Placed& receivers,
                                    const OcclusionOptions& options) const;
  void look_up(const Placed& receivers, const detail::OcclusionLookup* lookup, const Progress& progress,
               std::vector<float>& visibility) const;

  gl::Context& context;
  const Scene& scene;
  const RayScene& rays;
  std::vector<const TriangleMesh*> casters;
  std::vector<double> thickness;  ///< one per caster
  detail::OcclusionMasks masks;
};

OcclusionTextures::Impl::Impl(gl::Context& context_, const Scene& scene_, const RayScene& rays_)
    : context(context_), scene(scene_), rays(rays_), masks(context_.functions()) {
  for (const SceneObject& object : scene.objects) {
    if (!object.casts || object.mesh.empty()) continue;
    casters.push_back(&object.mesh);
    thickness.push_back(detail::mean_thickness(object.mesh));
  }
}

OcclusionTextures::Impl::Placed OcclusionTextures::Impl::place(const Receivers& surface,
                                                               const detail::SliceSpace& space) const {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  Placed out{surface, space, std::vector<Vec3>(surface.size(), Vec3(kNowhere))};
  rays.arena().execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        if (surface.is_present(i)) out.places[i] = space.projection.local(surface.points[i]);
    });
  });
  return out;
}

/// A floor may go on to anywhere: of what does not cast no more counts than twice the depth at which a shadow
/// is seen.
detail::DepthRange OcclusionTextures::Impl::range_to_slice(const std::vector<detail::CasterExtent>& extents,
                                                           const detail::SeenRegion& region,
                                                           const Placed& receivers,
                                                           const OcclusionOptions& options) const {
  const LightProjection& light = receivers.space.projection;
  detail::DepthRange of_casters, others;
  for (const detail::CasterExtent& extent : extents) of_casters.add(extent.depth);
  if (options.range == SliceRange::kCasters) return of_casters;
  for (const SceneObject& object : scene.objects)
    for (const Vec3& p : object.mesh.positions())
      if (!object.casts) others.add(std::max(light.local(p).z, light.plane_depth()));
  detail::DepthRange all = of_casters;
  all.add(others);
  const detail::ShadowBounds shadow = detail::shadow_bounds(extents, region, receivers.space);
  double deepest = of_casters.far;
  for (const Vec3& p : receivers.places)
    if (p.z > deepest && shadow.contain(p, light)) deepest = p.z;
  all.far = std::min(all.far, 2.0 * deepest - of_casters.near);
  const double slice = (all.far - all.near) / options.slices;
  const bool contact = others.near < of_casters.far + slice;
  return options.range == SliceRange::kAuto && contact ? of_casters : all;
}

OcclusionTextures::Impl::Plan OcclusionTextures::Impl::plan(const Placed& receivers,
                                                            const OcclusionOptions& options) const {
  Plan plan;
  const detail::SliceSpace& space = receivers.space;
  const detail::SeenRegion region = detail::region_of(receivers.places, space);
  plan.nothing_casts = true;
  if (region.empty()) return plan;
  for (const TriangleMesh* mesh : casters) {
    plan.extents.push_back(detail::caster_extent(*mesh, space, region));
    plan.nothing_casts &= plan.extents.back().depth.empty();
  }
  if (plan.nothing_casts) return plan;
  plan.frustum = detail::fit_frustum(plan.extents, range_to_slice(plan.extents, region, receivers, options),
                                     space, options);
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
void OcclusionTextures::Impl::look_up(const Placed& from, const detail::OcclusionLookup* lookup,
                                      const Progress& progress, std::vector<float>& visibility) const {
  const Receivers& surface = from.surface;
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
        const double above = fraction_above_horizon(from.space.light, surface.points[i], surface.normals[i]);
        visibility[i] = static_cast<float>(above);
        if (!lookup || !(from.space.projection.weight(from.places[i]) > 0.0) || !(above > 0.0)) continue;
        pixels[receivers.count] = i;
        receivers.add(from.places[i], from.space.projection.direction(surface.normals[i]),
                      from.space.projection, above);
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
  const detail::ReceiverMiddle middle = detail::receiver_middle(surface);
  const detail::SliceSpace space{light, LightProjection(light, middle.middle, middle.least_depth())};
  const Placed receivers = place(surface, space);
  const Plan plan = this->plan(receivers, options);
  clock.finish("frustum");
  std::uint64_t used = 0, bytes = 0;
  std::unique_ptr<detail::OcclusionLookup> lookup;
  if (!plan.nothing_casts) {
    auto slices = masks.draw(detail::mask_geometry(casters, plan.extents, space, plan.frustum), plan.drawings,
                             options, clock);
    report(progress, 0.0);
    rays.arena().execute(
        [&] { lookup = detail::make_occlusion_lookup(slices, plan.frustum, space, options); });
    clock.finish("prefilter");
    used = static_cast<std::uint64_t>(
        std::ranges::count_if(slices, [](const auto& texels) { return !texels.empty(); }));
    bytes = lookup->bytes();
    const auto thin = std::ranges::count_if(plan.drawings, &detail::CasterDrawing::fills_next);
    frame.counts.push_back({"thin_casters", static_cast<std::uint64_t>(thin)});
    frame.counts.push_back({"slice_thickness", plan.frustum.thickness});
    if (plan.frustum.by_offset > 0.0)
      frame.counts.push_back({"cop_offset", 1.0 / plan.frustum.by_offset});
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
  look_up(receivers, lookup.get(), progress, frame.visibility);
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
