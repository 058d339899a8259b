// Receivers that a single edge divides: the D-buffer is exact there.
#include <gtest/gtest.h>

#include <cmath>

#include "penumbra/volumes/volumes.h"
#include "tests/render/d_buffer/d_buffer_support.h"

namespace penumbra {
namespace {

using testing::draw_d_buffer;
using testing::Values;
using testing::View;

TEST(DBuffer, OneEdgeIsTheChordFormula) {
  // The shadow's boundary on a plane, from a caster with one edge near the receivers: penumbra of 40 texels.
  const double r = 0.8, z = 5.0, depth = 10.0;
  Scene scene = testing::scene_in_light_frame(r, {testing::rectangle(-10, 0.123, -10, 10, z)});
  scene.objects.push_back({"floor", testing::rectangle(-4, 4, -4, 4, depth), Vec3(0.8), false});
  const double extent = 2.0 * 10.0 / z + 2.0 * r * (1.0 / z - 1.0 / depth);
  const double texels = 2.0 * r * (1.0 / z - 1.0 / depth) * 1020 / extent;
  ASSERT_GE(texels, 34.0);
  std::vector<Vec3> points;
  std::vector<double> expected;
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 256; ++i) {
      const Vec3 p{-1.2 + 2.4 * (i + 0.5) / 256 + 0.246, -2.0 + 4.0 * (j + 0.37) / 64, depth};
      points.push_back(p);
      expected.push_back(half_plane_area(-(p.x + (0.123 - p.x) * depth / (depth - z)) / r));
    }
  // Few texels do as well: what a texel stores is good for every receiver, and each that touches the penumbra
  // is drawn.
  for (const int size : {1024, 100, 40}) {
    const DBufferFrame frame =
        draw_d_buffer(scene, testing::receivers(points, Vec3(0, 0, -1), 256), {.size = size});
    EXPECT_EQ(testing::count_in(frame.counts, "targets"), 1u);
    const double rms = testing::rms_difference(frame.visibility, expected);
    std::printf("one edge, penumbra %.1f texels wide: RMS difference %.2g\n", texels * (size - 4) / 1020,
                rms);
    EXPECT_LE(rms, 0.002) << size;
  }
}

/// Texel of a D-buffer with one perspective, in (x/z, y/z): it spans the casters and their penumbras down to
/// the farthest receiver, with four texels to spare.
double texel_size(const Scene& scene, const LightFrame& axes, int size) {
  const auto local = [&](const Vec3& p) {
    const Vec3 d = p - testing::light_of(scene).center;
    return Vec3(glm::dot(d, axes.u), glm::dot(d, axes.v), glm::dot(d, axes.w));
  };
  double farthest = 0.0;
  for (const SceneObject& object : scene.objects)
    for (const Vec3& p : object.mesh.positions()) farthest = std::max(farthest, local(p).z);
  glm::dvec2 low(1e9), high(-1e9);
  for (const SceneObject& object : scene.objects) {
    if (!object.casts) continue;
    for (const Vec3& world : object.mesh.positions()) {
      const Vec3 p = local(world);
      const double reach = testing::light_of(scene).radius * (1.0 / p.z - 1.0 / farthest);
      low = glm::min(low, glm::dvec2(p.x, p.y) / p.z - reach);
      high = glm::max(high, glm::dvec2(p.x, p.y) / p.z + reach);
    }
  }
  return std::max(high.x - low.x, high.y - low.y) / (size - 4);
}

struct BandEdge {
  Vec3 a, b;          ///< light's frame
  Vec3 apex1, apex2;  ///< of the faces beside it; equal at a boundary
};

/// The receiver's exact visibility where exactly one band edge divides its disk; `texels`: how wide the
/// penumbra is.
struct OneEdge {
  bool divides = false;
  double visibility = 0.0, texels = 0.0;
};

class OneEdgeOracle {
 public:
  OneEdgeOracle(const Scene& scene, int size)
      : scene_(scene), axes_(light_frame(testing::light_of(scene))), texel_(texel_size(scene, axes_, size)) {
    for (const SceneObject& object : scene.objects) {
      if (!object.casts) continue;
      const TriangleMesh& mesh = object.mesh;
      for (const EdgeId id : find_silhouettes(mesh, classify_faces(mesh, testing::light_of(scene))).band) {
        const Edge& e = mesh.edges()[index(id)];
        const Vec3 left = local(mesh.position(e.left_apex));
        edges_.push_back({local(mesh.position(e.from)), local(mesh.position(e.to)), left,
                          e.is_boundary() ? left : local(mesh.position(e.right_apex))});
      }
    }
  }

  OneEdge at(const Vec3& world, const Vec3& normal) const {
    const Vec3 x = local(world);
    const Vec3 n(glm::dot(normal, axes_.u), glm::dot(normal, axes_.v), glm::dot(normal, axes_.w));
    const double r = testing::light_of(scene_).radius;
    if (x.z <= 0.0 || chord_of_plane(n, x, r).delta < 1.0) return {};
    const BandEdge* found = nullptr;
    for (const BandEdge& e : edges_) {
      if (std::max(e.a.z, e.b.z) >= x.z) return {};  // kept to edges wholly between light and receiver
      const glm::dvec2 p = on_disk(e.a, x) / r, q = on_disk(e.b, x) / r;
      if (distance_to_center(p, q) > 1.0) continue;
      if (found || glm::dot(p, p) < 1.0 || glm::dot(q, q) < 1.0) return {};
      found = &e;
    }
    return found ? judge(*found, world, x) : OneEdge{};
  }

 private:
  Vec3 local(const Vec3& p) const {
    const Vec3 d = p - testing::light_of(scene_).center;
    return {glm::dot(d, axes_.u), glm::dot(d, axes_.v), glm::dot(d, axes_.w)};
  }
  /// Where the line from x through p meets the light's plane.
  static glm::dvec2 on_disk(const Vec3& p, const Vec3& x) {
    return glm::dvec2(x) + glm::dvec2(p - x) * (x.z / (x.z - p.z));
  }
  static double distance_to_center(const glm::dvec2& p, const glm::dvec2& q) {
    const glm::dvec2 d = q - p;
    return glm::length(p + std::clamp(-glm::dot(p, d) / glm::dot(d, d), 0.0, 1.0) * d);
  }
  OneEdge judge(const BandEdge& e, const Vec3& world, const Vec3& x) const {
    const double r = testing::light_of(scene_).radius;
    const Vec3 plane = edge_plane(x, e.a, e.b);
    const Chord chord = chord_of_plane(plane, x, r);
    // Either side is open or hidden as a whole; one ray into each says which.
    const auto open = [&](double distance) {
      const glm::dvec2 p = r * distance * chord.normal;
      return !testing::is_blocked(scene_, world,
                                  testing::light_of(scene_).center + p.x * axes_.u + p.y * axes_.v)
                  .hidden;
    };
    const double positive = open(0.5 * (1.0 - chord.delta)) ? 1.0 : 0.0;  // half-way between chord and rim
    const double negative = open(0.5 * (-1.0 - chord.delta)) ? 1.0 : 0.0;
    const double share = half_plane_area(chord.delta);
    // The penumbra's width in (x/z, y/z) is 2r (1/z of the edge - 1/z of the receiver).
    const glm::dvec2 p = on_disk(e.a, x), q = on_disk(e.b, x), middle = -r * chord.delta * chord.normal;
    const double t = std::clamp(glm::dot(middle - p, q - p) / glm::dot(q - p, q - p), 0.0, 1.0);
    // Perspective: a point of the edge weighs its ends by the *other* parameter's distance from the
    // receiver's plane.
    const double wa = (1.0 - t) * (x.z - e.a.z), wb = t * (x.z - e.b.z);
    const double z = (wa * e.a.z + wb * e.b.z) / (wa + wb);
    return {true, positive * share + negative * (1.0 - share), 2.0 * r * (1.0 / z - 1.0 / x.z) / texel_};
  }

  const Scene& scene_;
  LightFrame axes_;
  double texel_;
  std::vector<BandEdge> edges_;
};

TEST(DBuffer, ReceiversThatOneEdgeDividesAreExact) {
  for (const char* name : {"cube-medium", "boxes-medium", "triangle-medium", "torus-medium", "cube-large"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 320, 240);
    const DBufferFrame frame = draw_d_buffer(scene, view.surface, {.size = 1024});
    ASSERT_EQ(testing::count_in(frame.counts, "targets"), 1u) << name;
    const OneEdgeOracle oracle(scene, 1024);
    Values values;
    std::vector<double> exact;
    int partly = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < view.surface.size(); ++i) {
      if (!view.surface.hit(i) || view.surface.object[i] != 0) continue;
      const OneEdge one = oracle.at(view.surface.position[i], view.surface.normal[i]);
      if (!one.divides || one.texels < 34.0) continue;
      values.push_back(frame.visibility[i]);
      exact.push_back(one.visibility);
      partly += one.visibility > 0.0 && one.visibility < 1.0;
      worst = std::max(worst, std::abs(one.visibility - frame.visibility[i]));
    }
    const double rms = values.empty() ? 0.0 : testing::rms_difference(values, exact);
    std::printf("%-16s %zu receivers (%d partly lit), RMSE %.2g, worst %.2g\n", name, values.size(), partly,
                rms, worst);
    EXPECT_LE(rms, 0.001) << name;
    if (std::string(name).find("medium") != std::string::npos && std::string(name) != "torus-medium") {
      EXPECT_GT(partly, 200) << name;
    }
  }
}

}  // namespace
}  // namespace penumbra
