#include "render/occlusion_textures/frustum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace penumbra::detail {
namespace {

/// Depth before the light of a near light's point.
double depth_before(const Vec3& p, const LightProjection& light) {
  return light.weight(p) / light.nearness();
}

/// 1/d for the frustum through the light's border that contains every point. Every frustum of a distant
/// light, which has no border, is orthographic.
double offset_to_contain(const std::vector<CasterExtent>& casters, const SliceSpace& space) {
  if (space.light.distant) return 0.0;
  const LightProjection& light = space.projection;
  const glm::dvec2 half = space.light.half, center = light.tilt() / light.nearness();
  double by_offset = 0.0;
  const auto contain = [&](const Vec3& p) {
    const glm::dvec2 out = glm::abs(glm::dvec2(p) - center) / half;
    const double beyond = std::max(out.x, out.y) - 1.0;
    if (beyond > 0.0) by_offset = std::max(by_offset, beyond / std::max(depth_before(p, light), 0.0));
  };
  for (const CasterExtent& caster : casters) caster.for_each_point(contain);
  return std::min(by_offset, kWidestSlope / std::max(half.x, half.y));
}

/// The same center of projection in local coordinates.
void set_center(double by_offset, const LightProjection& light, SliceFrustum& frustum) {
  frustum.by_offset = by_offset;
  if (by_offset == 0.0) return;
  const double depth = 1.0 / light.nearness();
  frustum.narrowing = by_offset / (1.0 + by_offset * depth);
  frustum.slide = light.tilt() * depth * frustum.narrowing;
}

/// The smallest window of the light's proportions that contains every point.
void fit_window(const std::vector<CasterExtent>& casters, const glm::dvec2& half, int size,
                SliceFrustum& frustum) {
  glm::dvec2 low(1e300), high(-1e300);
  const auto contain = [&](const Vec3& p) {
    const glm::dvec2 q = frustum.place(p) / frustum.weight(p.z);
    low = glm::min(low, q);
    high = glm::max(high, q);
  };
  for (const CasterExtent& caster : casters) caster.for_each_point(contain);
  const glm::dvec2 middle = 0.5 * low + 0.5 * high, extent = (high - low) / (2.0 * half);
  // What has no width still has a texel's: of its depth, or of the least that double can tell at its place.
  const double smallest = std::max({1e-6 * frustum.thickness * frustum.count, 1e-12 * std::abs(middle.x),
                                    1e-12 * std::abs(middle.y), std::numeric_limits<double>::min()});
  const double times =
      std::max({extent.x, extent.y, smallest / std::max(half.x, half.y)}) * size / (size - 4.0);
  frustum.low = middle - times * half;
  frustum.high = middle + times * half;
}

/// The bounds of the region as distances that are positive inside and linear in the point.
class RegionPlanes {
 public:
  static constexpr int kCount = 6;
  RegionPlanes(const SeenRegion& region, const LightProjection& light) : region_(region), light_(light) {}
  using Distances = std::array<double, kCount>;

  Distances distances(const Vec3& p) const {
    const double weight = light_.weight(p), rise = -p.z - region_.bottom * weight;
    const glm::dvec2 place = light_.place(p), wider = rise * light_.spread();
    const glm::dvec2 from_low = place - region_.low * weight + wider,
                     from_high = region_.high * weight - place + wider;
    return {weight, rise, from_low.x, from_low.y, from_high.x, from_high.y};
  }
  /// Strictly in front of the light, and in the region: the region is convex.
  bool contain(const Bounds& world) const {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? world.high.x : world.low.x, corner & 2 ? world.high.y : world.low.y,
                   corner & 4 ? world.high.z : world.low.z};
      const Distances d = distances(light_.local(p));
      if (outside(d) || !(d[0] > 0.0)) return false;
    }
    return true;
  }
  static unsigned outside(const Distances& distances) {
    unsigned out = 0;
    for (unsigned k = 0; k < kCount; ++k) out |= !(distances[k] >= 0.0) ? 1u << k : 0u;
    return out;
  }

 private:
  const SeenRegion& region_;
  const LightProjection& light_;
};

struct ClippedCorner {
  Vec3 p;
  RegionPlanes::Distances distances;
};

ClippedCorner between(const ClippedCorner& a, const ClippedCorner& b, std::size_t plane) {
  const double t = a.distances[plane] / (a.distances[plane] - b.distances[plane]);
  ClippedCorner out{a.p + t * (b.p - a.p), {}};
  for (std::size_t k = 0; k < out.distances.size(); ++k)
    out.distances[k] = k == plane ? 0.0 : a.distances[k] + t * (b.distances[k] - a.distances[k]);
  return out;
}

/// Adds what of a triangle is inside of the planes.
void add_part(std::vector<ClippedCorner> polygon, unsigned planes, std::vector<LocalTriangle>& out) {
  std::vector<ClippedCorner> kept;
  for (std::size_t plane = 0; plane < RegionPlanes::kCount; ++plane) {
    if (!(planes >> plane & 1u)) continue;
    kept.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const ClippedCorner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const bool a_in = a.distances[plane] >= 0.0, b_in = b.distances[plane] >= 0.0;
      if (a_in) kept.push_back(a);
      if (a_in != b_in) kept.push_back(between(a, b, plane));
    }
    polygon.swap(kept);
  }
  for (std::size_t i = 2; i < polygon.size(); ++i)
    out.push_back({polygon[0].p, polygon[i - 1].p, polygon[i].p});
}

/// Of a caster that may reach out of the region.
void find_parts(const TriangleMesh& mesh, const RegionPlanes& planes, CasterExtent& out) {
  std::vector<RegionPlanes::Distances> distances;
  std::vector<unsigned> outside;
  for (const Vec3& p : out.vertices) {
    distances.push_back(planes.distances(p));
    outside.push_back(RegionPlanes::outside(distances.back()));
    out.whole &= outside.back() == 0;
    out.cut |= !(distances.back()[0] > 0.0);
  }
  if (out.whole) return;
  for (const auto& [a, b, c] : mesh.triangles()) {
    if (outside[a] & outside[b] & outside[c]) continue;
    const auto corner = [&](std::uint32_t v) { return ClippedCorner{out.vertices[v], distances[v]}; };
    add_part({corner(a), corner(b), corner(c)}, outside[a] | outside[b] | outside[c], out.parts);
  }
}

}  // namespace

void DepthRange::add(double w) {
  near = std::min(near, w);
  far = std::max(far, w);
}

void DepthRange::add(const DepthRange& other) {
  near = std::min(near, other.near);
  far = std::max(far, other.far);
}

SeenRegion region_of(std::span<const Vec3> places, const SliceSpace& space) {
  SeenRegion out;
  for (const Vec3& p : places) {
    const double weight = space.projection.weight(p);
    if (!(weight > 0.0)) continue;
    const glm::dvec2 q = space.projection.place(p) / weight;
    out.low = glm::min(out.low, q);
    out.high = glm::max(out.high, q);
    out.bottom = std::min(out.bottom, -p.z / weight);
  }
  return out;
}

CasterExtent caster_extent(const TriangleMesh& mesh, const SliceSpace& space, const SeenRegion& region) {
  const RegionPlanes planes(region, space.projection);
  CasterExtent out;
  out.vertices.reserve(mesh.positions().size());
  for (const Vec3& world : mesh.positions()) out.vertices.push_back(space.projection.local(world));
  if (!planes.contain(mesh.bounds())) find_parts(mesh, planes, out);
  out.for_each_point([&](const Vec3& p) { out.depth.add(p.z); });
  return out;
}

bool ShadowBounds::contain(const Vec3& local, const LightProjection& light) const {
  const double weight = light.weight(local);
  if (!(weight > 0.0)) return false;
  const glm::dvec2 q = light.place(local) / weight;
  return low.x <= q.x && q.x <= high.x && low.y <= q.y && q.y <= high.y;
}

ShadowBounds shadow_bounds(const std::vector<CasterExtent>& casters, const SeenRegion& region,
                           const SliceSpace& space) {
  ShadowBounds out;
  const LightProjection& light = space.projection;
  const auto add = [&](const Vec3& p) {
    // Of what touches the light's plane the shadow may fall anywhere.
    const double weight = std::max(light.weight(p), std::numeric_limits<double>::min());
    const glm::dvec2 q = light.place(p) / weight, reach = (-p.z / weight - region.bottom) * light.spread();
    out.low = glm::min(out.low, q - reach);
    out.high = glm::max(out.high, q + reach);
  };
  for (const CasterExtent& caster : casters) caster.for_each_point(add);
  return out;
}

SliceFrustum fit_frustum(const std::vector<CasterExtent>& casters, const DepthRange& depth,
                         const SliceSpace& space, const OcclusionOptions& options) {
  SliceFrustum frustum;
  frustum.count = options.slices;
  const double by_offset = !options.cop_offset   ? offset_to_contain(casters, space)
                           : space.light.distant ? 0.0
                                                 : 1.0 / *options.cop_offset;
  set_center(by_offset, space.projection, frustum);
  frustum.thickness = (depth.far - depth.near) / options.slices;
  fit_window(casters, space.light.half, options.texture_size, frustum);
  // Casters without depth still have slices; all of their planes are then as good as one.
  const glm::dvec2 width = frustum.high - frustum.low;
  frustum.thickness =
      std::max(frustum.thickness, 1e-6 * std::max(width.x, width.y) * frustum.weight(depth.far));
  frustum.first = depth.far - options.slices * frustum.thickness;
  return frustum;
}

double mean_thickness(const TriangleMesh& mesh) {
  if (!mesh.is_closed()) return 0.0;
  double volume = 0.0, area = 0.0;
  for (const Component& c : mesh.components()) volume += std::abs(c.signed_volume);
  const auto p = mesh.positions();
  for (const IndexedTriangle& t : mesh.triangles())
    area += 0.5 * glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
  return area > 0.0 ? 2.0 * volume / area : 0.0;
}

bool may_leak(double thickness, const CasterExtent& extent, const SliceSpace& space,
              const SliceFrustum& frustum) {
  if (extent.depth.empty()) return false;
  const LightProjection& light = space.projection;
  const double sideways = frustum.thickness * std::max(light.spread().x, light.spread().y);
  return thickness * std::max(light.weight({0.0, 0.0, extent.depth.near}), 0.0) < sideways;
}

}  // namespace penumbra::detail
