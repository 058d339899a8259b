// Meshes of many faces, smooth and flat, closed and open; scenes of them, with all that stands under their
// light.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "penumbra/mesh/shapes.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/collect/light_band.h"
#include "render/silhouette/merge/merged_edges.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/subdivide.h"

namespace penumbra::testing {

/// Its vertices pushed along a smooth wave.
inline TriangleMesh waved(const TriangleMesh& mesh, double height) {
  std::vector<Vec3> points(mesh.positions().begin(), mesh.positions().end());
  const double size = bounds_of(points).radius();
  for (Vec3& p : points) {
    const Vec3 k = 5.0 / size * p;
    p += height * size * Vec3(std::sin(k.y + 0.3 * k.z), std::sin(k.z + 0.5 * k.x), std::sin(k.x));
  }
  return TriangleMesh::build(points, mesh.triangles());
}

/// Every face cut in four, so many times.
inline TriangleMesh divided(TriangleMesh mesh, int times) {
  for (int i = 0; i < times; ++i) mesh = cut_in_four(mesh);
  return mesh;
}

/// Its coordinates as floats have them.
inline TriangleMesh rounded_to_float(const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.positions()) points.emplace_back(glm::vec3(p));
  return TriangleMesh::build(points, mesh.triangles());
}

/// Three quarters of a waved sphere: with boundary.
inline TriangleMesh bowl(int level) {
  const TriangleMesh ball = waved(make_icosphere({1, 2, 3}, 2.0, level), 0.02);
  std::vector<IndexedTriangle> faces;
  for (const IndexedTriangle& t : ball.triangles())
    if (ball.positions()[t[0]].x < 2.0) faces.push_back(t);
  return TriangleMesh::build(ball.positions(), faces);
}

/// `level`: 4^level times as many faces as a box or an icosahedron.
inline std::map<std::string, TriangleMesh> fine_meshes(int level) {
  std::map<std::string, TriangleMesh> out;
  out["ball"] = make_icosphere({0, 0, 0}, 1.0, level);
  out["bowl"] = bowl(level);
  out["waved box"] = waved(divided(make_box({4, 0, 1}, {1, 2, 0.5}), level), 0.01);
  out["box"] = divided(make_box({4, 0, 1}, {1, 2, 0.5}), 5);
  out["box in float"] = rounded_to_float(divided(make_box({0.3, 0.1, 0.2}, {1.1, 2.3, 0.7}), 5));
  return out;
}

/// A mesh as the only caster, under a light above it.
inline Scene scene_of(const TriangleMesh& mesh) {
  Scene scene;
  const Bounds box = bounds_of(mesh.positions());
  light_of(scene) = {box.center() + Vec3(0.3, 0.1, 3.0) * box.radius(), Vec3(0, 0, -1), 0.3 * box.radius()};
  scene.objects.push_back({"caster", mesh, Vec3(0.8), true});
  return scene;
}

/// In the frame of rays.
inline detail::MergedEdges merged_edges_of(const Scene& scene) {
  const RayFrame frame = ray_frame(scene);
  return {scene, frame.origin, frame.scale};
}

/// A scene under its light.
struct Stage {
  explicit Stage(const Scene& scene)
      : frame(ray_frame(scene)),
        light(light_of(scene)),
        edges(scene, frame.origin, frame.scale),
        lit(scene, light, edges, scene.bounds()),
        band(detail::make_band(lit, edges)) {}
  RayFrame frame;
  detail::UnitLight light;
  detail::SceneEdges edges;
  detail::LitScene lit;
  /// Of all faces.
  detail::Band band;
};

}  // namespace penumbra::testing
