#include "mesh/topology/cavities.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra::detail {
namespace {

/// How much of all directions from x the triangle takes up, positive where it faces away from x. Van Oosterom
/// and Strackee, "The solid angle of a plane triangle" (1983).
double solid_angle(const Vec3& x, const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 a = p - x, b = q - x, c = r - x;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double above = glm::dot(a, glm::cross(b, c));
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return std::atan2(above, below) / (2.0 * std::numbers::pi);
}

class CavityFinder {
 public:
  CavityFinder(std::span<const Component> components, std::span<const Vec3> positions,
               std::span<const IndexedTriangle> triangles)
      : components_(components), positions_(positions), triangles_(triangles) {
    for (const Component& component : components) {
      bounds_.emplace_back();
      for (const FaceId f : component.faces)
        for (const std::uint32_t v : triangles[index(f)]) bounds_.back().add(positions[v]);
    }
  }

  std::vector<bool> run() const {
    std::vector<bool> is_cavity(components_.size(), false);
    std::vector<std::size_t> inward;
    for (std::size_t i = 0; i < components_.size(); ++i)
      if (components_[i].closed && components_[i].signed_volume < 0.0) inward.push_back(i);
    std::ranges::stable_sort(inward, {}, [&](std::size_t i) { return components_[i].signed_volume; });
    for (const std::size_t i : inward) is_cavity[i] = winding_number(i, is_cavity) > 0.5;
    return is_cavity;
  }

 private:
  /// Of all other closed components that may hold component i, round the middle of its first face.
  double winding_number(std::size_t i, const std::vector<bool>& is_cavity) const {
    const auto& [a, b, c] = triangles_[index(components_[i].faces.front())];
    const Vec3 x = (positions_[a] + positions_[b] + positions_[c]) / 3.0;
    double winding = 0.0;
    for (std::size_t j = 0; j < components_.size(); ++j) {
      const bool may_hold = j != i && components_[j].closed && holds(bounds_[j], bounds_[i]);
      if (!may_hold) continue;
      double share = 0.0;
      for (const FaceId f : components_[j].faces) {
        const auto& [p, q, r] = triangles_[index(f)];
        share += solid_angle(x, positions_[p], positions_[q], positions_[r]);
      }
      const bool is_turned = components_[j].signed_volume < 0.0 && !is_cavity[j];
      winding += is_turned ? -share : share;
    }
    return winding;
  }

  static bool holds(const Bounds& outer, const Bounds& inner) {
    return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
           outer.high.x >= inner.high.x && outer.high.y >= inner.high.y && outer.high.z >= inner.high.z;
  }

  std::span<const Component> components_;
  std::span<const Vec3> positions_;
  std::span<const IndexedTriangle> triangles_;
  std::vector<Bounds> bounds_;
};

}  // namespace

std::vector<bool> find_cavities(std::span<const Component> components, std::span<const Vec3> positions,
                                std::span<const IndexedTriangle> triangles) {
  const bool any = components.size() > 1 && std::ranges::any_of(components, [](const Component& c) {
                     return c.closed && c.signed_volume < 0.0;
                   });
  if (!any) return std::vector<bool>(components.size(), false);
  return CavityFinder(components, positions, triangles).run();
}

}  // namespace penumbra::detail
