#include "render/silhouette/areas/disk_part.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/light/arc_sine.h"

namespace penumbra::detail {
namespace {

constexpr double kPi = std::numbers::pi;

/// The integral of the walk along the rim from the disk's lowest point to an event.
PENUMBRA_INLINE double walked_on_rim(const Event& e) {
  const double y = e.at.y < -1.0 ? -1.0 : e.at.y > 1.0 ? 1.0 : e.at.y, angle = arc_sine(y);
  return e.at.x < 0.0 ? 0.5 * (1.5 * kPi - angle) : 0.5 * (0.5 * kPi + angle);
}

PENUMBRA_VECTOR_CLONES
void walk_rim(const Event* events, std::size_t count, double* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = walked_on_rim(events[i]);
}

PENUMBRA_VECTOR_CLONES
void integrate_rim(const double* heights, std::size_t count, double* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const double y = heights[i] < -1.0 ? -1.0 : heights[i] > 1.0 ? 1.0 : heights[i];
    out[i] = 0.5 * (y * std::sqrt((1.0 - y) * (1.0 + y)) + arc_sine(y));
  }
}

/// An angle of more than -2π, to [0, 2π).
double turn(double angle) {
  return angle < 0.0 ? angle + 2.0 * kPi : angle;
}

}  // namespace

double DiskPart::half_width(double y) {
  return std::sqrt(std::max(0.0, (1.0 - y) * (1.0 + y)));
}

/// The chord runs from B = -δn - h d to A = -δn + h d, with d = (n.y, -n.x), so that D is on its left.
DiskPart::DiskPart(const Chord& horizon) : horizon_(horizon), cut_(horizon.delta < 1.0), area_(kPi) {
  if (!cut_) {
    horizon_ = no_horizon();
    return;
  }
  // The chord.
  const glm::dvec2 n = horizon.normal;
  const double delta = horizon.delta;
  area_ = kPi * half_plane_area(delta);
  half_ = half_width(delta);
  const glm::dvec2 foot = -delta * n, d{n.y, -n.x};
  const glm::dvec2 a = foot + half_ * d, b = foot - half_ * d;
  chord_on_left_ = n.x > 0.0 || (n.x == 0.0 && n.y > 0.0);
  arc_start_ = std::atan2(a.y, a.x);

  // Corners, and the lowest and highest point.
  middle_height_ = foot.y;
  corners_ = {a.y, b.y};
  bottom_on_arc_ = delta - n.y > 0.0;
  if (!bottom_on_arc_) bottom_ = std::min(a.y, b.y), lowest_x_ = a.y < b.y ? a.x : b.x;
  if (!(delta + n.y > 0.0)) top_ = std::max(a.y, b.y);

  // Where the walk begins.
  if (bottom_on_arc_)
    bottom_walk_ = from_chord_start({{0.0, -1.0}, false, 0});
  else if (chord_on_left_)
    bottom_walk_ = delta * half_;
}

std::pair<double, double> DiskPart::span(double y, double half_width) const {
  double left = -half_width, right = half_width;
  if (cut_ && horizon_.normal.x != 0.0) {
    const double chord = -(horizon_.normal.y * y + horizon_.delta) / horizon_.normal.x;
    if (horizon_.normal.x > 0.0)
      left = std::max(left, chord);
    else
      right = std::min(right, chord);
  }
  return {left, right};
}

double DiskPart::distance_to_boundary(const glm::dvec2& from, const glm::dvec2& direction) const {
  const double along = glm::dot(from, direction);
  const double rim = -along + std::sqrt(std::max(0.0, along * along + 1.0 - glm::dot(from, from)));
  const double descent = -glm::dot(horizon_.normal, direction);
  return descent > 0.0 ? std::min(rim, height(horizon_, from) / descent) : rim;
}

/// The integral of the walk from the chord's start B: δ/2 times the length along the chord, half the angle
/// along the arc.
double DiskPart::from_chord_start(const Event& e) const {
  if (e.on_chord) {
    const glm::dvec2 n = horizon_.normal;
    return 0.5 * horizon_.delta * std::clamp(e.at.x * n.y - e.at.y * n.x + half_, 0.0, 2.0 * half_);
  }
  return horizon_.delta * half_ + 0.5 * turn(std::atan2(e.at.y, e.at.x) - arc_start_);
}

/// Whether the walk from the chord's start meets the event before the lowest point. Decided by sides and
/// heights, as rows of scanlines decide it, not by angles: the two must agree.
bool DiskPart::before_bottom(const Event& e) const {
  if (!bottom_on_arc_) return chord_on_left_ && e.on_chord;
  if (e.on_chord) return true;
  if (chord_on_left_) return on_left(e) && e.at.y < middle_height_;
  return on_left(e) || e.at.y > middle_height_;
}

double DiskPart::walked(const Event& e) const {
  if (!cut_) return walked_on_rim(e);
  return from_chord_start(e) - bottom_walk_ + (before_bottom(e) ? area_ : 0.0);
}

double DiskPart::sum_walked(std::span<const Event> events) const {
  double sum = 0.0;
  if (cut_) {
    for (const Event& e : events) sum += e.change * walked(e);
    return sum;
  }
  std::array<double, 32> walks;
  for (; !events.empty(); events = events.subspan(std::min(walks.size(), events.size()))) {
    const auto some = events.first(std::min(walks.size(), events.size()));
    walk_rim(some.data(), some.size(), walks.data());
    for (std::size_t i = 0; i < some.size(); ++i) sum += some[i].change * walks[i];
  }
  return sum;
}

void integrate_rim(std::span<const double> heights, std::span<double> out) {
  integrate_rim(heights.data(), heights.size(), out.data());
}

glm::dvec2 DiskPart::middle() const {
  return cut_ ? 0.5 * (1.0 - horizon_.delta) * horizon_.normal : glm::dvec2(0.0);
}

}  // namespace penumbra::detail
