// Silhouette method, step clip: the part of the disk above a receiver's horizon, and its boundary.
//
// D = {|p| ≤ 1, n·p + δ ≥ 0} is convex. Its boundary is an arc of the rim and, where -1 < δ < 1, a chord.
// The boundary is walked counter-clockwise from D's lowest point: up the right side, then down the left
// side. A point of the boundary belongs to the right side where D lies to its left.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <utility>

#include "render/light/disk_area.h"
#include "render/silhouette/collect/tile_receiver.h"

namespace penumbra::detail {

/// n·p + δ: positive above the horizon.
inline double height(const Chord& c, const glm::dvec2& p) {
  return c.normal.x * p.x + c.normal.y * p.y + c.delta;
}

/// A point where a segment leaves or enters D.
struct Event {
  glm::dvec2 at;
  /// On the chord, else on the rim.
  bool on_chord;
  /// By how much the number of hiding faces changes there on the walk.
  int change;
};

class DiskPart {
 public:
  /// Requires δ > -1.
  explicit DiskPart(const Chord& horizon);

  const Chord& horizon() const { return horizon_; }
  bool is_cut() const { return cut_; }
  /// π for the whole disk.
  double area() const { return area_; }
  /// The least and the greatest height.
  double bottom() const { return bottom_; }
  double top() const { return top_; }
  /// The lowest point, as if something crossed the boundary there.
  Event lowest() const { return {{lowest_x_, bottom_}, !bottom_on_arc_, 0}; }
  /// Half the width of the unit disk at height y.
  static double half_width(double y);
  /// The ends of D's horizontal line at height y, where the rim is at ±half_width; empty where first ≥
  /// second. Given the mean of half_width over a slab of heights that holds no corner of D, these are the
  /// means of D's ends.
  std::pair<double, double> span(double y, double half_width) const;
  /// Heights of the two corners between arc and chord; for the whole disk those of its poles.
  std::array<double, 2> corner_heights() const { return corners_; }
  /// From a point of D along a unit direction.
  double distance_to_boundary(const glm::dvec2& from, const glm::dvec2& direction) const;
  /// Whether an event lies on the left side of the boundary.
  bool on_left(const Event& e) const { return e.on_chord ? chord_on_left_ : e.at.x < 0.0; }
  /// Whether the walk meets `a` before `b`.
  bool comes_first(const Event& a, const Event& b) const {
    const bool left = on_left(a);
    if (left != on_left(b)) return !left;
    if (a.on_chord && b.on_chord) {
      const glm::dvec2 way = a.at - b.at;
      return horizon_.normal.x * way.y - horizon_.normal.y * way.x > 0.0;
    }
    return left ? a.at.y > b.at.y : a.at.y < b.at.y;
  }
  /// ∫ (x dy - y dx)/2 along the boundary from the lowest point to the event.
  double walked(const Event& e) const;
  /// Σ change · walked(event). Events on the rim are done in vectors.
  double sum_walked(std::span<const Event> events) const;
  /// A point well inside D.
  glm::dvec2 middle() const;

 private:
  bool before_bottom(const Event& e) const;
  double from_chord_start(const Event& e) const;

  Chord horizon_;
  bool cut_;
  bool chord_on_left_ = false, bottom_on_arc_ = true;
  double area_, bottom_ = -1.0, top_ = 1.0, lowest_x_ = 0.0;
  std::array<double, 2> corners_{-1.0, 1.0};
  /// Half the length of the chord, and the height of its middle.
  double half_ = 0.0, middle_height_ = 0.0;
  /// The angle at which the arc begins, where the chord ends.
  double arc_start_ = 0.0;
  /// The integral of the walk from the start of the chord to the lowest point.
  double bottom_walk_ = 0.0;
};

/// ∫ √(1 - y²) dy from 0 to each height; `out` is as long as `heights`.
void integrate_rim(std::span<const double> heights, std::span<double> out);

}  // namespace penumbra::detail
