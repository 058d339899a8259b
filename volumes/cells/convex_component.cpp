#include "volumes/cells/convex_component.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra::detail {

namespace {

// Accuracy: how far an edge may bend inward, as a fraction of the component's radius. Some thousand
// roundings.
constexpr double kSlack = 1e-12;

bool bends_outward(const TriangleMesh& mesh, const Edge& edge, double slack) {
  const Vec3 &a = mesh.position(edge.from), &b = mesh.position(edge.to), &c = mesh.position(edge.left_apex);
  const Vec3 normal = glm::cross(b - a, c - a);
  return glm::dot(normal, mesh.position(edge.right_apex) - a) <= slack * glm::length(normal);
}

/// Signed solid angle of a triangle from the origin (van Oosterom and Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), below);
}

}  // namespace

bool is_convex(const TriangleMesh& mesh, const Component& component) {
  if (!component.closed) return false;
  Bounds bounds;
  Vec3 centroid(0.0);
  for (const FaceId f : component.faces) {
    for (const std::uint32_t v : mesh.triangles()[index(f)]) {
      bounds.add(mesh.positions()[v]);
      centroid += mesh.positions()[v] / (3.0 * static_cast<double>(component.faces.size()));
    }
  }
  const double slack = kSlack * bounds.radius();
  for (const FaceId f : component.faces) {
    for (const EdgeId e : mesh.face_edges()[index(f)]) {
      const Edge& edge = mesh.edges()[index(e)];
      if (edge.left == f && !bends_outward(mesh, edge, slack)) return false;
    }
  }
  double angle = 0.0;
  for (const FaceId f : component.faces) {
    const IndexedTriangle& t = mesh.triangles()[index(f)];
    angle += solid_angle(mesh.positions()[t[0]] - centroid, mesh.positions()[t[1]] - centroid,
                         mesh.positions()[t[2]] - centroid);
  }
  return std::abs(angle - 4.0 * std::numbers::pi) < 1.0;
}

}  // namespace penumbra::detail
