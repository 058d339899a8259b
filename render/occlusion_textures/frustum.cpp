#include "render/occlusion_textures/frustum.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

/// 1/d for the frustum through the light's border that contains every point.
double narrowing_to_contain(const std::vector<CasterExtent>& casters, const glm::dvec2& half) {
  double narrowing = 0.0;
  for (const CasterExtent& caster : casters)
    for (const Vec3& p : caster.points) {
      const double beyond = std::max(std::abs(p.x) / half.x, std::abs(p.y) / half.y) - 1.0;
      narrowing = std::max(narrowing, beyond / p.z);
    }
  return std::min(narrowing, kWidestSlope / std::max(half.x, half.y));
}

/// The smallest window of the light's proportions that contains every point.
void fit_window(const std::vector<CasterExtent>& casters, const glm::dvec2& half, int size,
                SliceFrustum& frustum) {
  glm::dvec2 low(1e300), high(-1e300);
  for (const CasterExtent& caster : casters)
    for (const Vec3& p : caster.points) {
      const glm::dvec2 q = frustum.project(p);
      low = glm::min(low, q);
      high = glm::max(high, q);
    }
  const glm::dvec2 middle = 0.5 * (low + high), extent = (high - low) / (2.0 * half);
  const double smallest = 1e-6 / std::max(half.x, half.y);
  const double times = std::max({extent.x, extent.y, smallest}) * size / (size - 4.0);
  frustum.low = middle - times * half;
  frustum.high = middle + times * half;
}

}  // namespace

void DepthRange::add(double z) {
  near = std::min(near, z);
  far = std::max(far, z);
}

void DepthRange::add(const DepthRange& other) {
  near = std::min(near, other.near);
  far = std::max(far, other.far);
}

CasterExtent caster_extent(const TriangleMesh& mesh, const SliceSpace& space) {
  std::vector<Vec3> points;
  points.reserve(mesh.positions().size());
  for (const Vec3& p : mesh.positions()) points.push_back(space.to_light(p));
  CasterExtent out;
  for (const Vec3& p : points) {
    if (p.z >= kNearSlice)
      out.points.push_back(p);
    else
      out.cut = true;
  }
  if (out.cut)
    for (const IndexedTriangle& t : mesh.triangles())
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = points[t[k]], &b = points[t[(k + 1) % 3]];
        if ((a.z >= kNearSlice) == (b.z >= kNearSlice)) continue;
        const Vec3 p = a + (b - a) * ((kNearSlice - a.z) / (b.z - a.z));
        out.points.push_back({p.x, p.y, kNearSlice});
      }
  for (const Vec3& p : out.points) out.depth.add(p.z);
  return out;
}

SliceFrustum fit_frustum(const std::vector<CasterExtent>& casters, const DepthRange& depth,
                         const SliceSpace& space, const OcclusionOptions& options) {
  SliceFrustum frustum;
  frustum.count = options.slices;
  // A scene without depth still has slices; all of its planes are then as good as one.
  frustum.thickness = std::max((depth.far - depth.near) / options.slices, 1e-6 * depth.far);
  frustum.first = depth.far - options.slices * frustum.thickness;
  frustum.narrowing = options.cop_offset ? 1.0 / (*options.cop_offset * space.scale)
                                         : narrowing_to_contain(casters, space.half);
  fit_window(casters, space.half, options.texture_size, frustum);
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
  const double sideways = frustum.thickness * std::max(space.half.x, space.half.y) / extent.depth.near;
  return thickness * space.scale < sideways;
}

}  // namespace penumbra::detail
