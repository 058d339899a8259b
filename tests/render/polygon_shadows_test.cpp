// The shadow of a concave or bridged polygon of a file has its notches and holes, whatever corner comes
// first.
#include <gtest/gtest.h>

#include <cmath>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/render/visibility.h"

namespace penumbra {
namespace {

/// How close a point of the plane y = 0 is to the outline, and whether an odd number of its sides is to the
/// right.
struct Place {
  double distance = 1e9;
  bool inside = false;
};

Place place_of(const std::vector<Vec3>& outline, double x, double z) {
  Place place;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double along = ((x - a.x) * (b.x - a.x) + (z - a.z) * (b.z - a.z)) /
                         ((b.x - a.x) * (b.x - a.x) + (b.z - a.z) * (b.z - a.z));
    const double t = std::min(1.0, std::max(0.0, along));
    place.distance =
        std::min(place.distance, std::hypot(a.x + t * (b.x - a.x) - x, a.z + t * (b.z - a.z) - z));
    if ((a.z > z) != (b.z > z) && x < a.x + (z - a.z) / (b.z - a.z) * (b.x - a.x))
      place.inside = !place.inside;
  }
  return place;
}

class PolygonShadows : public testing::TestWithParam<const char*> {};

TEST_P(PolygonShadows, HaveNotchesAndHoles) {
  PolygonSoup soup =
      read_polygon_soup(std::filesystem::path(PENUMBRA_DATA) / "regressions" / "meshes" / GetParam());
  const DiskLight light{.center = {2, 100, 2}, .normal = {0, -1, 0}, .radius = 0.01};
  for (std::size_t turned = 0; turned < soup.corners.size(); ++turned) {
    std::ranges::rotate(soup.corners, soup.corners.begin() + 1);
    std::vector<Vec3> outline, receivers;
    for (const std::uint32_t v : soup.corners) outline.push_back(soup.positions[v]);
    std::vector<float> expected;
    for (double x = -0.95; x < 6.0; x += 0.1)
      for (double z = -0.95; z < 6.0; z += 0.1) {
        const Place place = place_of(outline, x, z);
        if (place.distance < 0.01) continue;
        receivers.push_back(light.center + 1.01 * (Vec3(x, 0, z) - light.center));
        expected.push_back(place.inside ? 0.0f : 1.0f);
      }
    const TriangleMesh mesh = TriangleMesh::build(soup.positions, triangulate(soup).triangles);
    const Casters casters({&mesh, 1}, 1);
    for (const char* method : {"silhouette", "reference"})
      EXPECT_EQ(visibility(casters, light, {.points = receivers}, {.method = method}).visibility, expected)
          << method << ", corner " << turned;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, PolygonShadows,
                         testing::Values("good-concave-l.obj", "good-bridged-hole.obj", "good-comb.ply",
                                         "good-dart-quad.obj"));

}  // namespace
}  // namespace penumbra
