// Silhouette method, between steps 2 and 3: a tile's edges in float, and what dismisses most of them cheaply.
//
// In: a tile's edges. Out: those that some of its receivers, or one of them, must look at in double, with
// their jumps where floats are sure of them. Both passes go over arrays of floats and vectorise; they dismiss
// an edge only with a margin that covers rounding. In coordinates that start at the tile's middle an edge
// whose ends are at most s from there has coordinates off by 2^-24 s; M is the scene's extent in light radii.
//
// `narrow` asks the questions of shaft.h again, for fewer receivers: an edge is dismissed where
// it lies 2^-19 (M + s)(1 + |slope|) beyond a plane of the shaft, or where its faces keep their sides.
//
// `test_edges` asks for one receiver x: projection with w = x.z - p.z, g = x.z/w makes errors at most 2^-24 (s g)(2
// + s/w) times a small number, plus 2^-24 M for x itself. An edge is dismissed where it stays 2^-19 (M + s g
// (1 + s/w)) outside of the disk, w the smaller one of its ends, or where both faces keep their sides by the
// planes' tolerances and 2^-20 of the sum's terms.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette/collect/shaft.h"

namespace penumbra::detail {

class EdgeList {
 public:
  /// `middle`: where the float coordinates start. Cost O(edges).
  void assign(const Band& band, std::span<const std::uint32_t> edges, const Vec3& middle);
  /// Some of a list's edges, by their indices in it, with the same middle; `list` must outlive this.
  void assign(const EdgeList& list, std::span<const std::uint32_t> indices);

  std::size_t size() const { return places_.size(); }
  /// Where an edge stands in the tile's list; `edge` and `ends` go by that.
  std::int32_t place(std::size_t i) const { return places_[i]; }
  const std::int32_t* places() const { return places_.data(); }
  const BandEdge& edge(std::int32_t place) const { return *tile().edges_[static_cast<std::size_t>(place)]; }
  /// Six numbers a place: a and b in the light's frame, in double.
  const double* ends() const { return tile().ends_.data(); }
  const Vec3& middle() const { return middle_; }
  double extent() const { return extent_; }
  std::size_t bytes() const;

  /// One array a number: ends, their largest coordinate, planes with offset and tolerance.
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
  const EdgeList& tile() const { return tile_ ? *tile_ : *this; }
  void fill_columns();
  void fill_plane(const FacePlane& plane, std::size_t i, Column first);

  const EdgeList* tile_ = nullptr;      ///< the list this one is a part of
  std::vector<const BandEdge*> edges_;  ///< of a tile's list
  std::vector<double> ends_;            ///< of a tile's list
  std::vector<std::int32_t> places_;
  std::array<std::vector<float>, kColumns> columns_;
  Vec3 middle_{0.0};
  double extent_ = 1.0;
};

/// Indices of the edges that some receiver of the shaft must look at, ascending. Cost: some 270 flops an
/// edge.
void narrow(const EdgeList& list, const Shaft& shaft, std::vector<std::uint32_t>& out);

/// What is left of a list for one receiver.
struct TestedEdges {
  static constexpr std::int32_t kUnsure = 127;
  std::size_t count = 0;  ///< of edges; arrays may be longer
  std::vector<std::int32_t> places;
  std::vector<std::int32_t> jumps;  ///< faces on the left minus faces on the right, or kUnsure
  std::size_t looked_into = 0;      ///< blocks, where there are any
  std::vector<std::int32_t> blocks;
};

/// The edges that a receiver at x must look at, in the list's order. Cost: some 70 flops an edge. Compiled
/// for several instruction sets with the same result.
void test_edges(const EdgeList& list, const Vec3& x, TestedEdges& out);
/// Of edge `i`, computed for it alone without vectors, 0: dismissed, else its jump. Tests compare with it.
int test_edge(const EdgeList& list, std::size_t i, const Vec3& x);

}  // namespace penumbra::detail
