// Accurate rung, step 3 of 5: the edges of a tile's list as one receiver sees them, and the certificate.
//
// In: a tile's edges, a receiver x. Out: the segments that may cross the disk with a jump that is not 0,
// projected from x onto the plane of the disk: p → x + (p - x) x.z/(x.z - p.z). What an edge hides beyond x
// does not count, so edges are cut just below x's height (a hair of 2^-23 x.z, from where they project to
// infinity for the disk's purposes).
//
// Certificate: if no edge of the band meets the disk, seen from x, the number of faces between x and the disk
// is the same for all of its points; x is wholly lit or wholly in umbra, and one ray tells which. Edges are
// only dismissed with a margin that covers rounding, in two passes:
//
// 1. `sift`, in float, vectorised over edges, in coordinates that start at the tile's middle. With an edge's
//    ends at most s from there, each coordinate is off by 2^-24 s, and projection with w = x.z - p.z, g =
//    x.z/w makes that at most 2^-24 (s g)(2 + s/w) times a small number, plus 2^-24 M for x itself: an edge
//    is dismissed where it stays 2^-19 (M + s g (1 + s/w)) outside of the disk, w the smaller one of its
//    ends, or where both faces keep their sides by the planes' tolerances and 2^-20 of the sum's terms.
// 2. `see`, in double, for what is left: it is near where it comes within `slack` of the disk and its jump is
//    not certainly 0. Errors of coordinates, at most u M each, grow by x.z/w; the point of the segment that
//    is nearest to the disk, computed from ends at most 2^24 M away, is off by less than 2^-53 2^24 M times a
//    small number: slack = 1e-6 + 2^-26 M bounds both.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/disk_area.h"
#include "render/silhouette_frame.h"

namespace penumbra::detail {

/// A tile's edges as the two passes want them.
class EdgeList {
 public:
  /// `middle`: where the float coordinates start. Cost O(edges).
  void assign(const Band& band, std::span<const std::uint32_t> edges, const Vec3& middle);
  std::size_t size() const { return edges_.size(); }
  const BandEdge& operator[](std::size_t i) const { return *edges_[i]; }
  const Vec3& middle() const { return middle_; }
  double extent() const { return extent_; }
  std::size_t bytes() const;

  /// One array a number.
  enum Column {
    kAx,
    kAy,
    kAz,
    kBx,
    kBy,
    kBz,
    kSize,
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
    kColumns
  };
  const float* column(Column c) const { return columns_[c].data(); }

 private:
  std::vector<const BandEdge*> edges_;
  std::array<std::vector<float>, kColumns> columns_;
  Vec3 middle_{0.0};
  double extent_ = 1.0;
};

/// Which edges of the list may be near, in ascending order. Cost: some 70 flops an edge, vectorised; compiled
/// for several instruction sets with the same result.
void sift(const EdgeList& list, const Vec3& x, std::vector<std::uint32_t>& out);
/// Whether edge `i` is kept, computed for it alone without vectors: what tests compare with.
bool sift_one(const EdgeList& list, std::size_t i, const Vec3& x);

/// A segment in the plane of the disk, seen from the light's front; left minus right of a → b.
struct Segment {
  glm::dvec2 a, b;
  int jump;
};

struct Projection {
  Segment segment;
  bool near;  ///< may meet the disk with a jump, by the certificate's margin
};
/// An end that two edges share projects to the same bits in both.
Projection see(const BandEdge& edge, const Vec3& x, double slack);

double certificate_slack(double extent);

/// What one receiver sees: the segments that are near, have a jump, and are not wholly below its horizon.
struct Sight {
  std::vector<std::uint32_t> sifted;
  std::vector<Segment> segments;
  bool certain = false;  ///< no edge of the list meets the disk
};
void look(const EdgeList& list, const Vec3& x, const Chord& horizon, double slack, Sight& out);

}  // namespace penumbra::detail
