#include "render/occlusion_textures/lookup.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

/// Accuracy and speed: boxes that a disk is divided into for OcclusionKernel::kDisk. Each is one more lookup
/// a slice.
constexpr int kStrips = 5;

/// Area of the unit disk left of the line at x.
double area_left_of(double x) {
  return std::numbers::pi / 2.0 + std::asin(x) + x * std::sqrt(1.0 - x * x);
}

/// What the slices seen so far leave of the light, receiver by receiver. Shares are of what is above the
/// horizon.
PENUMBRA_VECTOR_CLONES
void hide(OcclusionCombine rule, const double* __restrict share, const double* above, std::size_t count,
          double* __restrict left) {
  switch (rule) {
    case OcclusionCombine::kProduct:
      for (std::size_t i = 0; i < count; ++i) left[i] *= 1.0 - share[i];
      break;
    case OcclusionCombine::kSum:
      for (std::size_t i = 0; i < count; ++i) left[i] -= above[i] * share[i];
      break;
    case OcclusionCombine::kMaximum:
      for (std::size_t i = 0; i < count; ++i) left[i] = std::min(left[i], above[i] * (1.0 - share[i]));
      break;
  }
}

/// Where a slice lies, in numbers that a lookup needs.
struct Plane {
  double depth;                ///< w
  glm::dvec2 texels_per_unit;  ///< on this plane
  glm::dvec2 origin;           ///< texels at u = v = 0
};

/// What the light fills at unit depth: half extents, and of the box around all its parts in units of those.
struct LightExtent {
  glm::dvec2 spread;
  double reach;
};

/// The light as receivers see it on a plane, about (u, v), in texels.
struct SeenLights {
  alignas(64) std::array<double, SliceReceivers::kMost> u, v, half_u, half_v;
};

/// Accuracy: so many texels above the horizon texels may still show the surface that the receiver lies on
/// (OcclusionTextures.ASidePlaneSeesItsHalfOfTheSun).
constexpr double kBias = 0.75;

/// Each is at least a texel wide: a smaller one would see single texels. What of it is too low moves up and
/// shrinks.
PENUMBRA_VECTOR_CLONES
void project_light(const SliceReceivers& __restrict from, const Plane& plane, const LightExtent& light,
                   SeenLights& __restrict out) {
  const double texel_u = 1.0 / plane.texels_per_unit.x, texel_v = 1.0 / plane.texels_per_unit.y;
  const double spread_u = light.spread.x, spread_v = light.spread.y, reach = light.reach, depth = plane.depth;
  for (std::size_t i = 0; i < from.count; ++i) {
    const double step = from.w[i] - depth, way = step * from.per_weight[i];
    const double u = from.toward_u[i] * way, v = from.toward_v[i] * way;
    const double half_u = std::max(spread_u * way, 0.5 * texel_u),
                 half_v = std::max(spread_v * way, 0.5 * texel_v);
    // Along the direction up the horizon: half a texel, half the light, and the light's middle above the
    // horizon.
    const double up_u = std::abs(from.up_u[i]), up_v = std::abs(from.up_v[i]);
    const double texel = 0.5 * (up_u * texel_u + up_v * texel_v),
                 half = reach * (up_u * half_u + up_v * half_v);
    const double middle = from.up_u[i] * u + from.up_v[i] * v + from.climb[i] * step,
                 lowest = 2.0 * kBias * texel;
    const bool is_low = middle - half < lowest;
    const double kept = is_low ? std::max(0.5 * (middle + half - lowest), reach * texel) : half;
    const double rise = is_low ? lowest + kept - middle : 0.0, shrink = is_low ? kept / half : 1.0;
    out.u[i] = plane.origin.x + (from.u[i] + u + from.up_u[i] * rise) * plane.texels_per_unit.x;
    out.v[i] = plane.origin.y + (from.v[i] + v + from.up_v[i] * rise) * plane.texels_per_unit.y;
    out.half_u[i] = half_u * shrink * plane.texels_per_unit.x;
    out.half_v[i] = half_v * shrink * plane.texels_per_unit.y;
  }
}

/// One part of the light: a box of texels for each receiver.
PENUMBRA_VECTOR_CLONES
void take_part(const SeenLights& __restrict lights, const KernelPart& part, TexelBoxes& __restrict boxes) {
  for (std::size_t i = 0; i < boxes.count; ++i) {
    boxes.x0[i] = lights.u[i] + part.x0 * lights.half_u[i];
    boxes.x1[i] = lights.u[i] + part.x1 * lights.half_u[i];
    boxes.y0[i] = lights.v[i] + part.y0 * lights.half_v[i];
    boxes.y1[i] = lights.v[i] + part.y1 * lights.half_v[i];
  }
}

/// Adds what boxes see covered, as parts of the light. Far beside the texture rounding leaves a box no width.
PENUMBRA_VECTOR_CLONES
void add_shares(const TexelBoxes& boxes, const double* __restrict covered, double part,
                double* __restrict share) {
  for (std::size_t i = 0; i < boxes.count; ++i) {
    const double area = (boxes.x1[i] - boxes.x0[i]) * (boxes.y1[i] - boxes.y0[i]);
    share[i] += area > 0.0 ? part * covered[i] / area : 0.0;
  }
}

/// A slice fades in behind its plane, from nothing to all of it over its thickness.
PENUMBRA_VECTOR_CLONES
void fade_in(const SliceReceivers& receivers, const Plane& plane, double per_thickness,
             double* __restrict share) {
  for (std::size_t i = 0; i < receivers.count; ++i) {
    const double fade = std::clamp((receivers.w[i] - plane.depth) * per_thickness, 0.0, 1.0);
    share[i] = fade * std::clamp(share[i], 0.0, 1.0);
  }
}

Plane plane_of(const SliceFrustum& frustum, int slice, const OcclusionOptions& options) {
  const double depth = frustum.plane(slice), weight = frustum.weight(depth);
  const glm::dvec2 texels = static_cast<double>(options.texture_size) / (frustum.high - frustum.low);
  return {depth, texels / weight, (frustum.slide * depth / weight - frustum.low) * texels};
}

template <class Filter>
class FilteredSlices : public OcclusionLookup {
 public:
  FilteredSlices(const std::vector<SliceTexels>& slices, const SliceFrustum& frustum, const SliceSpace& space,
                 const OcclusionOptions& options)
      : filters_(slices.size()),
        parts_(kernel_parts(space.light, options.kernel)),
        extent_{space.projection.spread(), 0.0},
        per_thickness_(1.0 / frustum.thickness),
        rule_(options.combine) {
    for (int i = 0; i < frustum.count; ++i) planes_.push_back(plane_of(frustum, i, options));
    for (const KernelPart& part : parts_) extent_.reach = std::max(extent_.reach, part.x1);
    tbb::parallel_for(std::size_t{0}, slices.size(), [&](std::size_t i) {
      if (!slices[i].empty()) filters_[i] = std::make_unique<Filter>(slices[i], options.texture_size);
    });
  }

  void look_up(SliceReceivers& receivers) const override {
    Work work;
    auto& left = receivers.visibility;
    std::copy_n(receivers.above.begin(), receivers.count, left.begin());
    const double* farthest = std::max_element(receivers.w.data(), receivers.w.data() + receivers.count);
    for (std::size_t i = 0; i < planes_.size() && receivers.count && planes_[i].depth < *farthest; ++i) {
      if (!filters_[i]) continue;
      find_shares(receivers, i, work);
      hide(rule_, work.share.data(), receivers.above.data(), receivers.count, left.data());
    }
    for (std::size_t i = 0; i < receivers.count; ++i) left[i] = std::clamp(left[i], 0.0, receivers.above[i]);
  }

  std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const auto& filter : filters_) sum += filter ? filter->bytes() : 0;
    return sum;
  }

 private:
  struct Work {
    SeenLights lights;
    TexelBoxes boxes;
    alignas(64) std::array<double, SliceReceivers::kMost> covered, share;
  };

  /// The share of the light that one slice hides, receiver by receiver.
  void find_shares(const SliceReceivers& receivers, std::size_t slice, Work& work) const {
    work.boxes.count = receivers.count;
    std::fill_n(work.share.begin(), receivers.count, 0.0);
    project_light(receivers, planes_[slice], extent_, work.lights);
    for (const KernelPart& part : parts_) {
      take_part(work.lights, part, work.boxes);
      filters_[slice]->covered(work.boxes, work.covered.data());
      add_shares(work.boxes, work.covered.data(), part.share, work.share.data());
    }
    fade_in(receivers, planes_[slice], per_thickness_, work.share.data());
  }

  std::vector<std::unique_ptr<Filter>> filters_;  ///< none where the slice is empty
  std::vector<Plane> planes_;
  std::vector<KernelPart> parts_;
  LightExtent extent_;
  double per_thickness_;
  OcclusionCombine rule_;
};

}  // namespace

void SliceReceivers::add(const Vec3& p, const Vec3& normal, const LightProjection& light,
                         double above_horizon) {
  u[count] = p.x;
  v[count] = p.y;
  w[count] = p.z;
  per_weight[count] = 1.0 / light.weight(p);
  toward_u[count] = light.tilt().x - light.nearness() * p.x;
  toward_v[count] = light.tilt().y - light.nearness() * p.y;
  // A horizon along the plane is far below, and every way along the plane is up it: a vector of length 0
  // would give the light no extent that way, and project_light divides by that.
  const double along = std::hypot(normal.x, normal.y);
  up_u[count] = along > 0.0 ? normal.x / along : 1.0;
  up_v[count] = along > 0.0 ? normal.y / along : 0.0;
  climb[count] = -normal.z / std::max(along, 1e-12);
  above[count++] = above_horizon;
}

std::vector<KernelPart> kernel_parts(const AreaLight& light, OcclusionKernel kernel) {
  if (!light.disk) return {{-1.0, -1.0, 1.0, 1.0, 1.0}};
  const double side = 0.5 * std::sqrt(std::numbers::pi);
  if (kernel == OcclusionKernel::kBox) return {{-side, -side, side, side, 1.0}};
  std::vector<KernelPart> parts;
  for (int i = 0; i < kStrips; ++i) {
    const double x0 = 2.0 * i / kStrips - 1.0, x1 = 2.0 * (i + 1) / kStrips - 1.0;
    const double area = area_left_of(x1) - area_left_of(x0), half_height = 0.5 * area / (x1 - x0);
    parts.push_back({x0, -half_height, x1, half_height, area / std::numbers::pi});
  }
  return parts;
}

std::unique_ptr<OcclusionLookup> make_occlusion_lookup(const std::vector<SliceTexels>& slices,
                                                       const SliceFrustum& frustum, const SliceSpace& space,
                                                       const OcclusionOptions& options) {
  switch (options.filter) {
    case OcclusionFilter::kMipmap:
      return std::make_unique<FilteredSlices<MipPyramid>>(slices, frustum, space, options);
    case OcclusionFilter::kNBuffer:
      return std::make_unique<FilteredSlices<NBuffer>>(slices, frustum, space, options);
    case OcclusionFilter::kSummedArea:
      break;
  }
  return std::make_unique<FilteredSlices<SummedArea>>(slices, frustum, space, options);
}

}  // namespace penumbra::detail
