#include "render/soft_shadow_volumes/layers.h"

namespace penumbra::detail {
namespace {

/// Calls `met(object)` for one face after the other until it returns false. The ray goes on where it met a
/// face: in that face's plane, which hides nothing from there.
template <class Met>
void follow(Ray ray, const RayScene& rays, const Met& met) {
  constexpr int kMostFaces = 1'000;
  for (int i = 0; i < kMostFaces; ++i) {
    const auto hit = first_hit(rays, ray);
    if (!hit || !met(hit->object)) return;
    const Vec3 at = ray.from.point + hit->distance * ray.way;
    if (!ray.endless) ray.way = (1.0 - hit->distance) * ray.way;
    ray.from = {at, static_cast<std::int32_t>(hit->object), hit->face};
  }
}

}  // namespace

std::vector<std::size_t> faces_met(Ray ray, const RayScene& rays, std::size_t objects) {
  std::vector<std::size_t> out(objects, 0);
  follow(ray, rays, [&](std::uint32_t object) {
    ++out[object];
    return true;
  });
  return out;
}

double layers_passed(Ray ray, const RayScene& rays, const std::vector<double>& layers, double enough) {
  double sum = 0.0;
  follow(ray, rays, [&](std::uint32_t object) { return (sum += layers[object]) < enough; });
  return sum;
}

}  // namespace penumbra::detail
