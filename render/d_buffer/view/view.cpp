#include "render/d_buffer/view/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra::detail {
namespace {

/// Speed. Facets up to this part of the target's width are narrow: one ray finds their reach instead of
/// three. Too large, and boundaries end too early or too late in the middle of facets
/// (DBufferScenes.ErrorOnTheFloor).
constexpr double kNarrow = 1.0 / 32.0;
/// Speed: how often the window is looked at again for its lowest receiver. Each time it may get smaller, if a
/// floor goes on to the horizon.
constexpr int kMostRounds = 8;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What casters are seen in, with their penumbras, and the greatest height of one.
struct CasterExtent {
  UvBounds uv;
  double high = -kInfinity;
};

/// A caster adds nothing where all of it is lower than `low`. One that crosses the light's plane may be seen
/// anywhere.
CasterExtent extent_of(const std::vector<glm::dvec4>& points, const CasterRange& range, double low,
                       double highest) {
  CasterExtent out;
  bool behind = false;
  for (std::size_t i = range.first_point; i < range.first_point + range.point_count; ++i) {
    if (points[i].w < LightSpace::kNearWeight) {
      behind = true;
      continue;
    }
    const Uvh p = divided(points[i]);
    const double reach = std::max(0.0, p.h - low);
    out.uv.add(p.uv - reach);
    out.uv.add(p.uv + reach);
    out.high = std::max(out.high, p.h);
  }
  if (behind && !out.uv.empty()) return {{glm::dvec2(-kInfinity), glm::dvec2(kInfinity)}, highest};
  return out.high > low ? out : CasterExtent{};
}

CasterExtent extent_of_all(const CasterTriangles& triangles, const CastersInLight& casters, double low,
                           double highest) {
  CasterExtent out;
  for (const CasterRange& range : triangles.ranges) {
    if (range.cannot_occlude) continue;
    const CasterExtent one = extent_of(casters.points, range, low, highest);
    out.uv.add(one.uv);
    out.high = std::max(out.high, one.high);
  }
  return out;
}

/// The height at the near weight: of w = weight - 1 over the nearness, -w · spread / weight.
double height_at_near(const LightSpace& space) {
  if (space.is_orthographic()) return kInfinity;
  return space.spread() * space.depth() * (1.0 / LightSpace::kNearWeight - 1.0);
}

struct Window {
  UvBounds uv;
  /// Of the lowest receiver, and of the highest point of a caster.
  double low, high;
};

Window find_window(const LightSpace& space, const CasterTriangles& triangles, const CastersInLight& casters,
                   const ReceiversInLight& receivers) {
  const UvBounds seen = receivers.bounds();
  Window out{seen, receivers.lowest(seen), -kInfinity};
  for (int round = 0; round < kMostRounds; ++round) {
    const CasterExtent extent = extent_of_all(triangles, casters, out.low, height_at_near(space));
    out.uv = common(seen, extent.uv);
    out.high = extent.high;
    const double low = receivers.lowest(out.uv);
    if (out.uv.empty() || !(low > out.low)) break;
    out.low = low;
  }
  return out;
}

/// Of the units of an axis-aligned perspective: a power of two, so that scaling does not round.
double unit_for(const Window& window) {
  const double size = std::max(window.uv.extent(), 0x1p-20 * (window.high - window.low));
  return std::exp2(std::ceil(std::log2(size)));
}

UvBounds in_window(const LightSpace& space, const UvBounds& b) {
  return {space.in_window(Uvh{b.low, 0.0}).uv, space.in_window(Uvh{b.high, 0.0}).uv};
}

}  // namespace

DBufferView choose_view(const LightSpace& space, const CasterTriangles& triangles,
                        const CastersInLight& casters, const ReceiversInLight& receivers, int size) {
  DBufferView view{space};
  const Window window = find_window(space, triangles, casters, receivers);
  if (window.uv.empty() || !(window.high > window.low) || !std::isfinite(window.low)) return view;
  if (!space.is_orthographic()) {
    view.space = space.with_window(space.end_of_axis(), space.depth());
    const UvBounds about_axis = in_window(view.space, window.uv);
    if (needs_hemicube(about_axis)) view.targets = hemicube(about_axis);
  }
  const double low_in_hemicube = view.space.in_window(Uvh{glm::dvec2(0.0), window.low}).h;
  if (view.is_hemicube()) {
    view.depth_scale = LightSpace::kNearWeight / space.spread();
  } else {
    view.space = space.with_window({window.uv.middle(), window.low}, unit_for(window));
    view.targets = {one_target(in_window(view.space, window.uv), size)};
    view.depth_scale = 0.5 * unit_for(window) / (window.high - window.low);
  }
  const auto& [left, right, bottom, top] = view.targets[0].window;
  const double width = std::max(right - left, top - bottom);
  view.footprint = {.far_height = view.is_hemicube() ? low_in_hemicube : 0.0,
                    .dilation = width / size,
                    .narrow = width * kNarrow,
                    .is_hemicube = view.is_hemicube(),
                    .half_window = 0.5 * width};
  return view;
}

}  // namespace penumbra::detail
