#include "volumes/solids/simplify/collapse_planner.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace penumbra::detail {
namespace {

using Side = SimplifyOptions::Side;

constexpr double kMargin = 2e-4;        ///< of the spacing, see PlacementOptions
constexpr std::size_t kMostFaces = 40;  ///< around an edge

}  // namespace

/// By the triangles around; those in sides of the box limit nothing, the point stays there.
bool CollapsePlanner::find_limits(std::uint32_t a, std::uint32_t b) {
  const ChangingSurface& s = surface_;
  limits_.clear();
  areas_.clear();
  const double sign = s.options.side == Side::kOutward ? -1.0 : 1.0;
  for (const std::uint32_t v : {a, b})
    for (const std::uint32_t f : s.faces_at[v]) {
      if (v == b && has(s.triangles[f], a)) continue;
      if (s.side_of(s.triangles[f]) != 0) continue;
      const std::array<Vec3, 3> c = s.corners(s.triangles[f]);
      const Vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
      const double twice = glm::length(n);
      if (!(twice > 0.0)) return false;
      limits_.push_back({sign / twice * n, sign / twice * glm::dot(n, c[0] - s.origin)});
      areas_.push_back(0.5 * twice);
    }
  return limits_.size() <= kMostFaces;
}

std::optional<CollapsePlan> CollapsePlanner::plan_for(std::uint32_t a, std::uint32_t b) {
  const ChangingSurface& s = surface_;
  const SimplifyOptions& options = s.options;
  const std::uint8_t sides = s.on_side[a] | s.on_side[b];
  if ((sides & 7 & sides >> 3) != 0 || !find_limits(a, b)) return std::nullopt;
  PlacementOptions placement{.rounding = s.rounding, .margin = kMargin * options.spacing};
  Vec3 start = 0.5 * (s.positions[a] + s.positions[b]) - s.origin, fixed(0.0);
  for (int k = 0; k < 3; ++k) {
    const bool low = sides >> k & 1, high = sides >> (k + 3) & 1;
    placement.fixed[k] = low || high;
    if (!placement.fixed[k]) continue;
    fixed[k] = low ? options.box.low[k] : options.box.high[k];
    start[k] = fixed[k] - s.origin[k];
  }
  Quadric quadric = s.quadrics[a];
  quadric += s.quadrics[b];
  const std::span<const PlaneLimit> bounds(limits_);
  const std::optional<Vec3> x =
      place_one_sided(quadric, options.side == Side::kEither ? bounds.first(0) : bounds, start, placement);
  if (!x) return std::nullopt;
  CollapsePlan plan{*x + s.origin, 0.0, 0.0};
  for (int k = 0; k < 3; ++k) {
    if (placement.fixed[k]) plan.point[k] = fixed[k];
    if (plan.point[k] < options.box.low[k] || plan.point[k] > options.box.high[k]) return std::nullopt;
  }
  double most = 0.0;
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    const double by = std::abs(glm::dot(limits_[i].normal, *x) - limits_[i].offset);
    plan.cost += areas_[i] * by / 3.0;
    most = std::max(most, by);
  }
  plan.error = std::max(s.errors[a], s.errors[b]) + most;
  if (!(plan.error <= options.tolerance)) return std::nullopt;
  // Among collapses that change nothing, short edges first.
  plan.cost += 1e-9 * options.spacing * options.spacing * glm::distance(s.positions[a], s.positions[b]);
  return plan;
}

}  // namespace penumbra::detail
