// The guarantee of penumbra volumes, point by point: none that is not fully lit is outside. Half of the
// points are within 1e-3 of the volume's surface, half anywhere in a box.
#pragma once

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <sstream>

#include "penumbra/volumes/volumes.h"
#include "tests/volumes/convex_pieces.h"
#include "tests/volumes/shadow_oracle.h"

namespace penumbra::testing {

inline constexpr double kNearSurface = 1e-3;  // scene units

struct ContainmentFigures {
  std::size_t cells = 0, triangles = 0;
  long points = 0, shaded_near = 0, shaded_anywhere = 0, inside_near = 0, inside_anywhere = 0, outside = 0;
  long exact = 0;  ///< decisions of the oracle in rationals
  int most = 0;    ///< greatest winding number seen

  long shaded() const { return shaded_near + shaded_anywhere; }

  void add(const ContainmentFigures& other) {
    cells = other.cells;
    triangles = other.triangles;
    points += other.points;
    shaded_near += other.shaded_near;
    shaded_anywhere += other.shaded_anywhere;
    inside_near += other.inside_near;
    inside_anywhere += other.inside_anywhere;
    outside += other.outside;
    exact += other.exact;
    most = std::max(most, other.most);
  }

  std::string text() const {
    const auto lit = [](long shaded, long inside) {
      return inside > 0 ? 100.0 * static_cast<double>(inside - shaded) / static_cast<double>(inside) : 0.0;
    };
    std::ostringstream out;
    out << "cells " << cells << ", triangles " << triangles << "; of " << points
        << " points not fully lit: " << shaded_near << " near, " << shaded_anywhere << " anywhere, outside "
        << outside << "; inside but fully lit: " << lit(shaded_near, inside_near) << "% near, "
        << lit(shaded_anywhere, inside_anywhere) << "% anywhere; greatest winding " << most
        << "; exact decisions " << exact;
    return out.str();
  }
};

class ContainmentCheck {
 public:
  ContainmentCheck(const TriangleMesh& mesh, const CircularLight& light, const ShadowMesh& volume,
                   const Bounds& box, std::uint64_t seed)
      : seed_(seed),
        random_(seed),
        volume_(volume),
        box_(box),
        light_(light),
        oracle_(mesh, light),
        pieces_(volume.positions, volume.triangles, light) {
    figures_.cells = volume.cells;
    figures_.triangles = volume.triangles.size();
  }

  bool is_sum_of_convex_cells() const {
    return pieces_.size() == volume_.cells && pieces_.all_convex_and_closed();
  }

  void run(int count) {
    run(count, [](const Vec3&) { return false; });
  }

  /// `other` is one more judge: whether light is hidden from a point, asked of points outside of the volume.
  template <class Judge>
  void run(int count, const Judge& other) {
    for (int i = 0; i < count; ++i) {
      const bool near = i % 2;
      const Vec3 x = near ? near_surface() : anywhere();
      const bool inside = pieces_.winding_number(x, 1) >= 1;
      const bool shaded = oracle_.is_partly_hidden(x) || (!inside && other(x));
      ++figures_.points;
      (near ? figures_.shaded_near : figures_.shaded_anywhere) += shaded;
      (near ? figures_.inside_near : figures_.inside_anywhere) += inside;
      if (i % 100 == 0) figures_.most = std::max(figures_.most, pieces_.winding_number(on_some_cell()));
      if (!shaded || inside) continue;
      ++figures_.outside;
      ADD_FAILURE() << "seed " << seed_ << ", point " << i << ": (" << x.x << ", " << x.y << ", " << x.z
                    << ") is not fully lit but outside";
      if (figures_.outside > 3) break;
    }
    figures_.exact = static_cast<long>(oracle_.exact_decisions());
  }
  const ContainmentFigures& figures() const { return figures_; }

 private:
  bool usable(const Vec3& x) const {
    for (int k = 0; k < 3; ++k) {
      if (x[k] < box_.low[k] || x[k] > box_.high[k]) return false;
    }
    return side_of_light_plane(x, light_) == Sign::kPositive;
  }

  Vec3 anywhere() {
    for (;;) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = random_.uniform(box_.low[k], box_.high[k]);
      if (usable(x)) return x;
    }
  }

  /// A point within 1e-3 of the volume's outside. Several in a row are by the same place of it, which is
  /// costly to find.
  Vec3 near_surface() {
    constexpr int kUses = 8, kAttempts = 100;
    if (uses_++ % kUses == 0) surface_ = outer_surface_point();
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Vec3 x = surface_ + std::pow(random_.uniform(0.0, 1.0), 3.0) * kNearSurface * random_.direction();
      if (usable(x)) return x;
    }
    return anywhere();
  }

  /// Where a ray from the inside leaves the volume for the last time.
  Vec3 outer_surface_point() {
    constexpr int kAttempts = 100;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Vec3 start = on_some_cell(), way = anywhere() - start;
      const double t = pieces_.last_exit(start, way);
      if (t >= 0.0 && t < 1.0) return start + t * way;
    }
    return anywhere();  // the volume fills the box
  }

  /// A point on the surface of some cell, inside of others as a rule; towards the near corners, since the far
  /// ones are beyond the box.
  Vec3 on_some_cell() {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const std::size_t i = static_cast<std::size_t>(random_.uniform(0.0, 1.0) * volume_.triangles.size());
      const IndexedTriangle& t = volume_.triangles[i];
      Vec3 weights(random_.uniform(0, 1), random_.uniform(0, 1), random_.uniform(0, 1));
      weights *= weights * weights;
      const Vec3 p = (weights.x * volume_.positions[t[0]] + weights.y * volume_.positions[t[1]] +
                      weights.z * volume_.positions[t[2]]) /
                     (weights.x + weights.y + weights.z);
      if (usable(p)) return p;
    }
    return anywhere();
  }

  std::uint64_t seed_;
  RandomInputs random_;
  const ShadowMesh& volume_;
  Bounds box_;
  CircularLight light_;
  ShadowOracle oracle_;
  ConvexPieces pieces_;
  Vec3 surface_{0.0};
  int uses_ = 0;
  ContainmentFigures figures_;
};

}  // namespace penumbra::testing
