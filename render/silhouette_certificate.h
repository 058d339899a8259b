// Accurate rung, step 3 of 5: the edges of a tile's list as one receiver sees them, and the certificate.
//
// In: a tile's edges, a receiver x. Out: the segments that may cross the disk with a jump that is not 0,
// projected from x onto the plane of the disk: p → x + (p - x) x.z/(x.z - p.z). What an edge hides beyond x
// does not count, so edges are cut just below x's height (a hair of 2^-23 x.z, from where they project to
// infinity for the disk's purposes).
//
// Certificate: if no edge of the band meets the disk, seen from x, the number of faces between x and the disk
// is the same for all of its points; x is wholly lit or wholly in umbra, and one ray tells which. Edges are
// only dismissed with a margin that covers rounding: `near` counts those that come within `slack` of the disk
// and whose jump is not certainly 0. Projection magnifies errors of coordinates, at most u M each, by
// x.z/(x.z
// - p.z); the point of the segment that is nearest to the disk, computed from ends at most 2^24 M away, is
// off by less than 2^-53 2^24 M times a small number: slack = 1e-6 + 2^-26 M bounds both.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/disk_area.h"
#include "render/silhouette_frame.h"

namespace penumbra::detail {

/// A tile's edges, one array a number, so that loops over edges vectorise.
class EdgeList {
 public:
  void assign(const Band& band, std::span<const std::uint32_t> edges);
  std::size_t size() const { return size_; }

  enum Column {
    kAx,
    kAy,
    kAz,
    kBx,
    kBy,
    kBz,
    kLx,
    kLy,
    kLz,
    kLd,
    kLt,
    kRx,
    kRy,
    kRz,
    kRd,
    kRt,
    kRight,
    kColumns
  };
  const double* column(Column c) const { return columns_[c].data(); }

 private:
  std::size_t size_ = 0;
  std::array<std::vector<double>, kColumns> columns_;
};

/// A segment in the plane of the disk, seen from the light's front; left minus right of a → b.
struct Segment {
  glm::dvec2 a, b;
  int jump;
};

/// What the projection found for every edge of a list (arrays at least as long as the list).
struct Projections {
  void resize(std::size_t n);
  std::vector<double> ax, ay, bx, by;
  std::vector<float> jump;         ///< left minus right, -2 to 2
  std::vector<std::uint8_t> near;  ///< may meet the disk with a jump, by the certificate's margin
};

/// Cost: some 80 flops an edge, vectorised; compiled for several instruction sets with the same result.
void project_edges(const EdgeList& list, const Vec3& x, double slack, Projections& out);
/// The same for edge `i` alone, without vectors: what tests compare with.
void project_edge(const EdgeList& list, std::size_t i, const Vec3& x, double slack, Projections& out);

double certificate_slack(double extent);

/// The segments of one receiver: near, with a jump, and not wholly below its horizon.
struct Sight {
  std::vector<Segment> segments;
  bool certain = false;  ///< no edge of the list meets the disk
};
void select_segments(const Projections& projections, std::size_t count, const Chord& horizon, Sight& out);

}  // namespace penumbra::detail
