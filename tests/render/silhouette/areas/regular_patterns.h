// Blinds, fences, gratings, combs and moirés in the plane of the disk, chosen against the rows of
// areas/rows.h: along and across them and beside, with periods that are multiples and fractions of their
// distances or nearly so.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "render/silhouette/collect/tile_receiver.h"
#include "tests/render/silhouette/areas/random_segments.h"

namespace penumbra::testing {

struct RegularPattern {
  /// One of pattern_kinds().
  std::string kind;
  std::vector<detail::Segment> segments;
  Chord horizon = detail::no_horizon();
};

inline const std::vector<std::string>& pattern_kinds() {
  static const std::vector<std::string> all{
      "blinds",  "moire",    "crossed", "wires", "comb",  "cells",     "diamonds",  "thin", "slits",
      "lattice", "quarters", "patch",   "bars",  "three", "two_combs", "both_ways", "pairs"};
  return all;
}

/// Draws one pattern.
class PatternMaker {
 public:
  /// `number`: its rest by the number of kinds says which kind. `most`: of segments.
  PatternMaker(int number, std::size_t most)
      : random_(static_cast<std::uint64_t>(number) * 7919 + 13), kind_(number), most_(most) {}

  RegularPattern make() {
    static constexpr std::array kMakers{
        &PatternMaker::blinds, &PatternMaker::moire,   &PatternMaker::crossed,   &PatternMaker::wires,
        &PatternMaker::comb,   &PatternMaker::cells,   &PatternMaker::diamonds,  &PatternMaker::thin,
        &PatternMaker::slits,  &PatternMaker::lattice, &PatternMaker::quarters,  &PatternMaker::patch,
        &PatternMaker::bars,   &PatternMaker::three,   &PatternMaker::two_combs, &PatternMaker::both_ways,
        &PatternMaker::pairs};
    const std::size_t kind = static_cast<std::size_t>(kind_) % kMakers.size();
    RegularPattern out;
    for (;;) {
      segments_.clear();
      jump_ = chance(2) ? 2 : 1;
      (this->*kMakers[kind])();
      if (segments_.size() > 20 && segments_.size() <= most_) break;
    }
    out.kind = pattern_kinds()[kind];
    out.segments = segments_;
    if (chance(5)) out.horizon = {random_.unit2(), random_.uniform(-0.6, 0.9)};
    return out;
  }

 private:
  using Point = glm::dvec2;
  /// The direction of the second family of rows, degrees.
  static constexpr double kOther = -1.24 * 180.0 / kPi;
  /// Axes turned by an angle.
  struct Axes {
    Point along, across;
    Point at(double x, double y) const { return x * along + y * across; }
  };

  static Axes axes(double degrees) {
    const double angle = degrees * kPi / 180.0;
    return {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
  }
  /// True once in n.
  bool chance(int n) { return random_.uniform(0, n) < 1.0; }
  int whole(int least, int most) { return least + static_cast<int>(random_.uniform(0, most - least + 1)); }

  /// A period beside a multiple or a fraction of the distance between rows.
  double period() {
    static constexpr std::array kMultiples{0.5,       2.0 / 3.0, 1.0, 1.0, 1.0, 4.0 / 3.0, 1.25,
                                           1.0 / 1.1, 1.0 / 0.9, 1.5, 2.0, 3.0, 4.0};
    const double exact = 2.0 / 64.0 * kMultiples[static_cast<std::size_t>(whole(0, kMultiples.size() - 1))];
    return chance(3) ? exact : exact * random_.uniform(0.95, 1.05);
  }
  double period_above(double least) {
    double p = period();
    while (p < least) p *= 2.0;
    return p;
  }
  /// Degrees, at or beside a direction of rows or a diagonal.
  double direction() {
    static constexpr std::array kDirections{0.0, 0.0, kOther, 90.0, 90.0 + kOther, 45.0, -45.0};
    const double exact = chance(8) ? random_.uniform(0, 180)
                                   : kDirections[static_cast<std::size_t>(whole(0, kDirections.size() - 1))];
    const int beside = whole(0, 3);
    return exact + (beside == 0   ? 0.0
                    : beside == 1 ? random_.uniform(-1, 1)
                    : beside == 2 ? random_.uniform(-0.05, 0.05)
                                  : random_.uniform(-6, 6));
  }

  void outline(const std::vector<Point>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      segments_.push_back({corners[k], corners[(k + 1) % corners.size()], jump_});
  }
  /// Whether something at a point may reach the disk.
  static bool is_near(const Point& p) { return p.x * p.x + p.y * p.y < 1.7; }
  void box(const Axes& f, double x0, double y0, double x1, double y1) {
    outline({f.at(x0, y0), f.at(x1, y0), f.at(x1, y1), f.at(x0, y1)});
  }
  void grating(double degrees, double period, double duty, double phase) {
    const int count = static_cast<int>(1.2 / period) + 2;
    for (int k = -count; k <= count; ++k)
      box(axes(degrees), -2, (k + phase) * period, 2, (k + phase + duty) * period);
  }
  void grating(double degrees, double period, double duty) {
    grating(degrees, period, duty, random_.uniform(0, 1));
  }
  void half_plane() { box(axes(direction()), -3, random_.uniform(-0.5, 0.5), 3, 6); }
  void comb_of(double degrees, double period) {
    const Axes f = axes(degrees);
    const double duty = random_.uniform(0.2, 0.8), base = random_.uniform(-0.8, -0.1),
                 tip = random_.uniform(0.0, 0.9);
    const int count = static_cast<int>(1.2 / period) + 2;
    std::vector<Point> corners{f.at(-2, base), f.at(2, base)};
    for (int k = count; k >= -count; --k)
      for (const auto& [x, y] : {std::pair{duty, base + 0.05}, {duty, tip}, {0.0, tip}, {0.0, base + 0.05}})
        corners.push_back(f.at((k + x) * period, y));
    outline(corners);
  }

  void blinds() { grating(direction(), period(), random_.uniform(0.1, 0.9)); }
  void moire() {
    const double a = direction(), p = period();
    grating(a, p, random_.uniform(0.2, 0.8));
    grating(chance(2) ? a : a + random_.uniform(-1, 1), chance(2) ? p : p * random_.uniform(0.95, 1.05),
            random_.uniform(0.2, 0.8));
  }
  void crossed() {
    const double a = direction(), p = period_above(0.05), duty = random_.uniform(0.2, 0.8);
    grating(a, p, duty);
    grating(a + (chance(2) ? 90.0 : random_.uniform(20, 160)), p, duty);
  }
  void wires() {
    const Axes f = axes(direction());
    const double p = period_above(0.06), wide = random_.uniform(0.001, 0.006),
                 wobble = random_.uniform(0, 0.02);
    const int count = static_cast<int>(1.2 / p) + 1, pieces = whole(3, 12);
    for (int k = -count; k <= count; ++k) {
      const double y = (k + random_.uniform(-0.3, 0.3)) * p;
      std::vector<Point> below, above;
      for (int q = 0; q <= pieces; ++q) {
        const double x = -1.3 + 2.6 * q / pieces, at = y + random_.uniform(-wobble, wobble);
        below.push_back(f.at(x, at));
        above.push_back(f.at(x, at + wide));
      }
      below.insert(below.end(), above.rbegin(), above.rend());
      outline(below);
    }
    if (chance(2)) half_plane();
  }
  void comb() { comb_of(direction(), period()); }
  void cells() {
    const Axes f = axes(direction());
    const double p = whole(1, 3) * period_above(0.12), size = random_.uniform(0.3, 0.999) * p,
                 dx = random_.uniform(0, p), dy = random_.uniform(0, p);
    const bool checked = chance(2);
    const int count = static_cast<int>(1.2 / p) + 1;
    for (int i = -count; i <= count; ++i)
      for (int j = -count; j <= count; ++j)
        if (is_near(f.at(i * p, j * p)) && (!checked || (i + j) % 2 == 0))
          box(f, i * p + dx, j * p + dy, i * p + dx + size, j * p + dy + size);
    if (chance(2)) half_plane();
  }
  void diamonds() {
    const Axes f = axes(direction());
    const double p = whole(1, 3) * period_above(0.12), q = whole(1, 3) * period_above(0.12),
                 size = random_.uniform(0.4, 0.98) / 2;
    const int columns = static_cast<int>(1.2 / p) + 1, rows = static_cast<int>(1.2 / q) + 1;
    for (int i = -columns; i <= columns; ++i)
      for (int j = -rows; j <= rows; ++j)
        if (is_near(f.at(i * p, j * q)))
          outline({f.at((i - size) * p, j * q), f.at(i * p, (j - size) * q), f.at((i + size) * p, j * q),
                   f.at(i * p, (j + size) * q)});
    if (chance(2)) half_plane();
  }
  void thin() {
    grating(direction(), period(), random_.uniform(0.02, 0.15));
    half_plane();
  }
  void slits() {
    grating(direction(), period(), random_.uniform(0.9, 0.99));
    if (chance(2)) half_plane();
  }
  /// Two layers either way of an axis: along rows they keep the same distance.
  double lattice_period(double slant) {
    return std::max(0.035, period() * whole(1, 2) * std::cos(slant * kPi / 180.0));
  }
  double lattice_axis() { return chance(2) ? 0.0 : chance(2) ? 90.0 : kOther; }
  void lattice() {
    const double slant = random_.uniform(20, 65), p = lattice_period(slant), duty = random_.uniform(0.3, 0.7),
                 axis = lattice_axis();
    grating(axis + slant, p, duty);
    grating(axis - slant, p, duty);
  }
  void quarters() {
    const double a = direction(), p = period(), phase = 0.25 * whole(0, 4);
    grating(a, p, 0.5, 0.0);
    grating(a, p, 0.5, phase);
    grating(chance(2) ? a + 90.0 : a, 2.0 * p, 0.5);
  }
  /// A lattice over a part of the disk.
  void patch() {
    const double slant = random_.uniform(8, 65), p = lattice_period(slant), duty = random_.uniform(0.3, 0.7),
                 axis = lattice_axis();
    const double wide = random_.uniform(0.1, 0.5);
    const int count = static_cast<int>(1.2 / p) + 2;
    for (const double turn : {slant, -slant}) {
      const double angle = turn * kPi / 180.0, half = wide / std::cos(angle);
      for (int k = -count; k <= count; ++k) {
        const double middle = -k * p * std::tan(angle);
        box(axes(axis + turn), middle - half, k * p, middle + half, (k + duty) * p);
      }
    }
  }
  void bars() {
    const double a = direction(), thick = random_.uniform(0.002, 0.04);
    const int count = whole(2, 9);
    for (int k = 0; k < count; ++k) {
      const double y = -1.0 + (k + random_.uniform(0.2, 0.8)) * 2.0 / count;
      box(axes(chance(2) ? a : a + random_.uniform(-0.5, 0.5)), -2, y, 2, y + thick);
    }
    half_plane();
    grating(random_.uniform(0, 180), random_.uniform(0.2, 0.6), random_.uniform(0.2, 0.7));
  }
  void three() {
    const double p = period_above(0.04);
    grating(direction(), p, random_.uniform(0.1, 0.6));
    grating(direction(), p * random_.uniform(0.95, 1.05), random_.uniform(0.1, 0.6));
    grating(direction(), p * whole(1, 2), random_.uniform(0.1, 0.6));
  }
  /// Along the rows of both families.
  void both_ways() {
    const double p = period_above(0.04), duty = random_.uniform(0.2, 0.8);
    grating(chance(2) ? 0.0 : random_.uniform(-0.1, 0.1), p, duty);
    grating(chance(2) ? kOther : kOther + random_.uniform(-0.1, 0.1), chance(2) ? p : 4.0 / 3.0 * p,
            chance(2) ? duty : random_.uniform(0.2, 0.8));
  }
  /// Two layers of halves each way, a quarter apart: their sum is the same wherever rows lie.
  void pairs() {
    const double p = whole(1, 3) * period_above(0.06), phase = random_.uniform(0, 1);
    for (const double degrees : {0.0, kOther})
      for (const double layer : {0.0, 0.25}) grating(degrees, p, 0.5, phase + layer);
  }
  void two_combs() {
    const double a = direction(), p = 2.0 * period();
    comb_of(a, p);
    comb_of(chance(2) ? a + 180.0 : a + random_.uniform(-3, 3), p);
  }

  Random random_;
  int kind_, jump_ = 2;
  std::size_t most_;
  std::vector<detail::Segment> segments_;
};

/// The same number gives the same pattern, of at most so many segments.
inline RegularPattern regular_pattern(int number, std::size_t most = 1500) {
  return PatternMaker(number, most).make();
}

}  // namespace penumbra::testing
