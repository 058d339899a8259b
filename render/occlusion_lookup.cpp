#include "render/occlusion_lookup.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <numbers>

namespace penumbra::detail {
namespace {

constexpr int kStrips = 5;

/// Area of the unit disk left of the line at x.
double area_left_of(double x) {
  return std::numbers::pi / 2.0 + std::asin(x) + x * std::sqrt(1.0 - x * x);
}

/// What the slices seen so far leave of the light.
class Combination {
 public:
  Combination(OcclusionCombine rule, double above) : rule_(rule), left_(above), above_(above) {}
  void hide(double share) {
    switch (rule_) {
      case OcclusionCombine::kProduct:
        left_ *= 1.0 - share;
        break;
      case OcclusionCombine::kSum:
        left_ -= share;
        break;
      case OcclusionCombine::kMaximum:
        left_ = std::min(left_, std::min(above_, 1.0 - share));
        break;
    }
  }
  double left() const { return std::clamp(left_, 0.0, above_); }

 private:
  OcclusionCombine rule_;
  double left_, above_;
};

/// Where a slice lies, in numbers that a lookup needs.
struct Plane {
  double depth;
  glm::dvec2 texels_per_unit;  ///< of the light's frame, on this plane
};

/// On the light's plane.
glm::dvec2 texels_per_unit(const SliceFrustum& frustum, const OcclusionOptions& options) {
  return static_cast<double>(options.texture_size) / (frustum.high - frustum.low);
}

template <class Filter>
class FilteredSlices : public OcclusionLookup {
 public:
  FilteredSlices(const std::vector<SliceTexels>& slices, const SliceFrustum& frustum, const SliceSpace& space,
                 const OcclusionOptions& options)
      : filters_(slices.size()),
        parts_(kernel_parts(space.light, options.kernel)),
        half_(space.half),
        origin_(-frustum.low * texels_per_unit(frustum, options)),
        per_thickness_(1.0 / frustum.thickness),
        rule_(options.combine) {
    for (int i = 0; i < frustum.count; ++i) {
      const double depth = frustum.plane(i);
      planes_.push_back({depth, texels_per_unit(frustum, options) / (1.0 + frustum.narrowing * depth)});
    }
    tbb::parallel_for(std::size_t{0}, slices.size(), [&](std::size_t i) {
      if (!slices[i].empty()) filters_[i] = std::make_unique<Filter>(slices[i], options.texture_size);
    });
  }

  double visibility(const Vec3& p, double above) const override {
    Combination combination(rule_, above);
    const double per_depth = 1.0 / p.z;
    const glm::dvec2 slope = glm::dvec2(p) * per_depth;
    for (std::size_t i = 0; i < planes_.size() && planes_[i].depth < p.z; ++i) {
      if (!filters_[i]) continue;
      const double fade = std::min(1.0, (p.z - planes_[i].depth) * per_thickness_);
      combination.hide(fade * hidden(*filters_[i], planes_[i], slope, per_depth));
    }
    return combination.left();
  }

  std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const auto& filter : filters_) sum += filter ? filter->bytes() : 0;
    return sum;
  }

 private:
  /// The share of the light that one slice hides. Kernels are at least a texel wide: a smaller one would see
  /// single texels.
  double hidden(const Filter& filter, const Plane& plane, const glm::dvec2& slope, double per_depth) const {
    const glm::dvec2 middle = origin_ + slope * plane.depth * plane.texels_per_unit;
    const glm::dvec2 half = half_ * (1.0 - plane.depth * per_depth) * plane.texels_per_unit;
    const double hx = std::max(half.x, 0.5), hy = std::max(half.y, 0.5);
    double sum = 0.0;
    for (const KernelPart& part : parts_) {
      const TexelBox box{middle.x + part.x0 * hx, middle.y + part.y0 * hy, middle.x + part.x1 * hx,
                         middle.y + part.y1 * hy};
      sum += part.share * filter.covered(box) / box.area();
    }
    return std::clamp(sum, 0.0, 1.0);
  }

  std::vector<std::unique_ptr<Filter>> filters_;  ///< none where the slice is empty
  std::vector<Plane> planes_;
  std::vector<KernelPart> parts_;
  glm::dvec2 half_, origin_;
  double per_thickness_;
  OcclusionCombine rule_;
};

}  // namespace

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
