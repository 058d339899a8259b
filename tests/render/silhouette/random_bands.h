// Bands of random casters, receivers under them, and comparisons of what they see.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "penumbra/mesh/shapes.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/collect/edge_list.h"
#include "render/silhouette/collect/light_band.h"
#include "render/silhouette/edges/projected_segment.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

/// The band of a scene's light.
inline detail::Band band_of(const Scene& scene) {
  const RayFrame frame = ray_frame(scene);
  const detail::UnitLight light(light_of(scene));
  const detail::SceneEdges edges(scene, frame.origin, frame.scale);
  return detail::make_band(detail::LitScene(scene, light, edges, scene.bounds()), edges);
}

/// Random triangles between light and receivers as a band.
inline detail::Band random_band(Random& random, int count, bool closed) {
  Scene scene = scene_in_light_frame(1.0, {});
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(0.5, 9)};
    const double size = random.spread(0.01, 2.0);
    const auto first = static_cast<std::uint32_t>(points.size());
    for (int k = 0; k < 4; ++k) points.push_back(middle + random.point(size));
    faces.push_back({first, first + 1, first + 2});
    if (!closed) continue;
    faces.push_back({first, first + 3, first + 1});
    faces.push_back({first + 1, first + 3, first + 2});
    faces.push_back({first + 2, first + 3, first});
  }
  scene.objects.push_back({"", mesh_of(points, faces), Vec3(0.8), true});
  return band_of(scene);
}

/// A finely divided sphere between light and receivers.
inline detail::Band sphere_band(Random& random) {
  Scene scene = scene_in_light_frame(1.0, {});
  const Vec3 middle{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(2, 5)};
  scene.objects.push_back({"", make_icosphere(middle, random.uniform(0.3, 1.5), 5), Vec3(0.8), true});
  return band_of(scene);
}

/// The same segments to the last bit, in any order.
inline void expect_same_segments(std::vector<detail::Segment> p, std::vector<detail::Segment> q) {
  const auto numbers = [](const detail::Segment& s) {
    return std::tuple(s.a.x, s.a.y, s.b.x, s.b.y, s.jump);
  };
  const auto before = [&](const detail::Segment& s, const detail::Segment& t) {
    return numbers(s) < numbers(t);
  };
  std::sort(p.begin(), p.end(), before);
  std::sort(q.begin(), q.end(), before);
  ASSERT_EQ(p.size(), q.size());
  for (std::size_t i = 0; i < p.size(); ++i) ASSERT_EQ(numbers(p[i]), numbers(q[i]));
}

/// Adds an edge that the edge test leaves.
inline void add_place(std::int32_t place, std::int32_t jump, detail::TestedEdges& out) {
  out.places.push_back(place);
  out.jumps.push_back(jump);
  ++out.count;
}

/// The same edges in the same order, with the same jumps.
inline void expect_same_places(const detail::TestedEdges& p, const detail::TestedEdges& q) {
  ASSERT_EQ(p.count, q.count);
  const auto n = static_cast<std::ptrdiff_t>(p.count);
  ASSERT_TRUE(std::equal(p.places.begin(), p.places.begin() + n, q.places.begin()));
  ASSERT_TRUE(std::equal(p.jumps.begin(), p.jumps.begin() + n, q.jumps.begin()));
}

/// Receivers near each other whose tangent plane may cut the disk.
inline std::vector<detail::TileReceiver> random_receivers(Random& random, std::size_t count) {
  std::vector<detail::TileReceiver> out;
  const Vec3 middle{random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(3, 10)};
  const double size = random.spread(0.01, 2.0);
  const Vec3 normal = glm::normalize(Vec3(0, 0, -1) + random.point(1.5));
  while (out.size() < count) {
    const Vec3 x = middle + random.point(size), n = glm::normalize(normal + random.point(0.05));
    const double center = -glm::dot(n, x), fall2 = n.x * n.x + n.y * n.y;
    const bool cuts = center * center < fall2;
    if (!cuts && center <= 0.0) return random_receivers(random, count);  // behind its own plane
    out.push_back({x, n, cuts ? chord_of_plane(n, x, 1.0) : detail::no_horizon(), cuts, 0});
  }
  return out;
}

}  // namespace penumbra::testing
