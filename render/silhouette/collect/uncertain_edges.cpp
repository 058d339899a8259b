#include "render/silhouette/collect/uncertain_edges.h"

#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "render/silhouette/edges/projected_segment.h"

namespace penumbra::detail {
namespace {

// Accuracy.
/// The largest margin of an edge that counts as itself, over the slack of the certificate, which covers it.
/// Held by the test UncertainEdges.CertificatesHoldToTheLast.
constexpr double kStraight = 1e-3;

/// 1 where only fronts of a side's faces are seen from a box of receivers, -1 where only backs, 0 where that
/// is not certain. `plane`: the side's mean plane.
PENUMBRA_INLINE int look_from(const Vec3& middle, const Vec3& half, const FacePlane& plane,
                              const MergedSides::Side& side) {
  if (plane.tolerance < 0.0) return 0;
  const double v = plane.value(middle);
  const double off = plane.tolerance + side.reach(middle) + glm::dot(glm::abs(plane.normal), half) +
                     (half == Vec3(0.0) ? 0.0 : side.tilt * glm::length(half));
  return std::abs(v) > off ? (v > 0.0 ? 1 : -1) : 0;
}

/// The place that is asked for, in coordinates in which it lies about (0, 0, 0).
PENUMBRA_INLINE Vec3 shifted(const Vec3& p, const DiskSpot& spot) {
  return {p.x - spot.center.x, p.y - spot.center.y, p.z};
}

/// A box lies beside the cone from receiver x to a spot of radius r about (0, 0, 0),
/// |p.xy - x.xy p.z/x.z| > r (1 - p.z/x.z), or below its tangent plane; by a margin of `slack` at the disk.
PENUMBRA_INLINE bool is_outside(const Vec3& middle, const Vec3& half, const Vec3& x, const Vec3& normal,
                                double radius, double slack) {
  const double per_z = 1.0 / x.z, t = middle.z * per_z;
  const double across = x.x * x.x + x.y * x.y, steep = (std::sqrt(across) + radius) * per_z;
  const double reach = radius * (1.0 - t) + std::sqrt(half.x * half.x + half.y * half.y) + half.z * steep +
                       slack * (1.0 + steep);
  const double dx = middle.x - t * x.x, dy = middle.y - t * x.y;
  if (reach < 0.0 || dx * dx + dy * dy > reach * reach) return true;
  return glm::dot(normal, middle - x) + glm::dot(glm::abs(normal), half) < -slack;
}

/// The segment comes within `reach` of (0, 0).
PENUMBRA_INLINE bool comes_within(const Segment& segment, double reach) {
  const glm::dvec2 &a = segment.a, s = segment.b - segment.a;
  const double s2 = glm::dot(s, s);
  const double t = s2 > 0.0 ? glm::clamp(-glm::dot(a, s) / s2, 0.0, 1.0) : 0.0;
  const glm::dvec2 nearest = a + t * s;
  return glm::dot(nearest, nearest) < reach * reach;
}

/// What `is_certainly_no_silhouette` asks first, for all receivers of a shaft.
bool is_none_for_all(const Band& band, std::size_t i, const Shaft& shaft) {
  const BandEdge& e = band.edges[i];
  const MergedSides& s = band.sides[i];
  const int left = look_from(shaft.middle(), shaft.half(), e.left, s.left),
            right = look_from(shaft.middle(), shaft.half(), e.right, s.right);
  return (left != 0 && left == right) || shaft.misses(s.middle - s.half, s.middle + s.half);
}

}  // namespace

bool is_certainly_no_silhouette(const Band& band, std::size_t i, const TileReceiver& receiver,
                                const DiskSpot& spot, double slack) {
  const BandEdge& e = band.edges[i];
  const MergedSides& sides = band.sides[i];
  const Vec3 x = shifted(receiver.x, spot);
  // It lies outside, or its faces all look the same way.
  if (is_outside(shifted(sides.middle, spot), sides.half, x, receiver.normal, spot.radius, slack))
    return true;
  const int left = look_from(receiver.x, Vec3(0.0), e.left, sides.left),
            right = look_from(receiver.x, Vec3(0.0), e.right, sides.right);
  if (left != 0 && left == right) return true;

  // The margin holds only for receivers far from the sides that they see edge-on, unless those lie below.
  const auto is_below = [&](const Vec3& p, double margin) {
    return glm::dot(receiver.normal, p - receiver.x) < -margin;
  };
  for (const auto& [looks, side] : {std::pair{left, &sides.left}, std::pair{right, &sides.right}})
    if (looks == 0 && !side->is_flat && !side->is_far(receiver.x) && !is_below(side->center, side->radius))
      return false;

  // It lies below the tangent plane, stands for itself, or lies above the receiver.
  if (is_below(e.a, sides.margin + slack) && is_below(e.b, sides.margin + slack)) return true;
  if (sides.margin <= slack * kStraight)
    return spot.is_point() || !project_segment(e.a, e.b, receiver.x, {slack}).near;
  if (std::min(e.a.z, e.b.z) - sides.margin > x.z) return true;

  // What is seen of it lies within its margin: as if it were an edge of one face, and the spot wider.
  const double below = x.z - std::max(e.a.z, e.b.z) - sides.margin;
  if (!(below > 0.0)) return false;
  const double steep = (glm::length(glm::dvec2(x)) + spot.radius) / x.z;
  const Segment seen = project_segment(shifted(e.a, spot), shifted(e.b, spot), x, {}).segment;
  return !comes_within(seen, spot.radius + slack + sides.margin * (1.0 + steep) * x.z / below);
}

void UncertainEdges::begin_tile(const Band& band, const std::vector<NodeMask>& list, const Shaft& shaft) {
  band_ = &band, list_ = &list, shaft_ = &shaft;
  part_ = {};
  collected_ = narrowed_ = false;
}

void UncertainEdges::begin_part(std::span<const TileReceiver> part) {
  part_ = part;
  narrowed_ = false;
}

void UncertainEdges::add(std::int32_t block, std::uint32_t edges, const Shaft& shaft,
                         const FloatShaft& in_float, std::vector<EdgesOfBlock>& out) const {
  const auto at = static_cast<std::size_t>(block);
  std::uint32_t left = 0;
  for (edges &= may_be_across(band_->lanes[at], in_float); edges != 0; edges &= edges - 1)
    if (!is_none_for_all(*band_, kFloatLanes * at + static_cast<std::size_t>(std::countr_zero(edges)), shaft))
      left |= edges & -edges;
  if (left != 0) out.push_back({block, left});
}

void UncertainEdges::collect() {
  constexpr std::uint32_t kAll = (1u << kFloatLanes) - 1;
  of_tile_.clear();
  const FloatShaft in_float(*shaft_, band_->extent);
  for_each_block(*list_, [&](std::size_t block) {
    add(static_cast<std::int32_t>(block), kAll, *shaft_, in_float, of_tile_);
  });
  collected_ = true;
}

void UncertainEdges::narrow() {
  of_part_.clear();
  narrowed_ = true;
  if (of_tile_.empty()) return;
  Shaft shaft(part_, band_->extent);
  shaft.tighten(part_);
  const FloatShaft in_float(shaft, band_->extent);
  for (const EdgesOfBlock& e : of_tile_) add(e.block, e.edges, shaft, in_float, of_part_);
}

bool UncertainEdges::are_none(const TileReceiver& receiver, const DiskSpot& spot, double slack) {
  if (!collected_) collect();
  if (!part_.empty() && !narrowed_) narrow();
  const std::vector<EdgesOfBlock>& edges_of_blocks = part_.empty() ? of_tile_ : of_part_;
  if (edges_of_blocks.empty()) return true;
  const FloatEye eye(receiver, spot, band_->extent);
  for (const EdgesOfBlock& e : edges_of_blocks) {
    const auto at = static_cast<std::size_t>(e.block);
    for (std::uint32_t edges = e.edges & may_be_across(band_->lanes[at], eye); edges != 0;
         edges &= edges - 1) {
      const std::size_t i = kFloatLanes * at + static_cast<std::size_t>(std::countr_zero(edges));
      if (!is_certainly_no_silhouette(*band_, i, receiver, spot, slack)) return false;
    }
  }
  return true;
}

}  // namespace penumbra::detail
