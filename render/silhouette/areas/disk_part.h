// Silhouette method: the part of the disk that a receiver's horizon leaves, and its boundary.
//
// D = {|p| ≤ 1, n·p + δ ≥ 0}, convex; its boundary is an arc, and a chord where -1 < δ < 1. It is walked
// counter-clockwise from D's lowest point: up the right side, down the left side. A boundary point belongs to
// the right side where D lies to its left. `Event`s are the points where segments leave or enter D; walking
// on, the number of hiding faces changes there by `change`.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <utility>

#include "render/light/disk_area.h"

namespace penumbra::detail {

/// n·p + δ: positive inside. The chord of a receiver whose horizon leaves the whole disk is `no_horizon`.
inline double height(const Chord& c, const glm::dvec2& p) {
  return c.normal.x * p.x + c.normal.y * p.y + c.delta;
}
inline Chord no_horizon() {
  return {glm::dvec2(0.0), 2.0};
}

struct Event {
  glm::dvec2 at;
  bool on_chord;
  int change;
};

class DiskPart {
 public:
  /// δ > -1.
  explicit DiskPart(const Chord& horizon);

  const Chord& horizon() const { return horizon_; }
  bool is_cut() const { return cut_; }
  double area() const { return area_; }  ///< π for the whole disk
  double bottom() const { return bottom_; }
  double top() const { return top_; }
  static double half_width(double y);  ///< of the unit disk
  /// Ends of D's horizontal line at height y, the rim being ±half_width; empty where first ≥ second. With the
  /// mean of half_width over a slab these are means of D's ends, where the slab holds no corner of D.
  std::pair<double, double> span(double y, double half_width) const;
  /// Heights of the two corners; those of the whole disk are its poles.
  std::array<double, 2> corner_heights() const { return corners_; }
  /// From a point of D in a unit direction.
  double distance_to_boundary(const glm::dvec2& from, const glm::dvec2& direction) const;
  /// The side of the boundary on which an event lies.
  bool on_left(const Event& e) const;
  /// Whether the walk meets `a` before `b`.
  bool comes_first(const Event& a, const Event& b) const;
  /// ∫ (x dy - y dx)/2 along the boundary from the lowest point to the event.
  double walked(const Event& e) const;
  /// Σ change · walked(event).
  double sum_walked(std::span<const Event> events) const;
  /// A point well inside.
  glm::dvec2 middle() const;

 private:
  bool before_bottom(const Event& e) const;
  double from_chord_start(const Event& e) const;

  Chord horizon_;
  bool cut_;
  bool chord_on_left_ = false, bottom_on_arc_ = true;
  double area_, bottom_ = -1.0, top_ = 1.0;
  std::array<double, 2> corners_{-1.0, 1.0};
  double half_ = 0.0;           ///< half the chord's length
  double arc_start_ = 0.0;      ///< angle at which the arc begins, where the chord ends
  double middle_height_ = 0.0;  ///< of the chord
  double bottom_walk_ = 0.0;    ///< the walk's integral from the chord's start to the lowest point
};

}  // namespace penumbra::detail
