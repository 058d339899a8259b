// Silhouette method, step collect: a tile's edges laid out in float, and the edge test that dismisses most
// of them.
//
// In: a tile's edges. Out: those that some of its receivers (`narrow`), or one of them (`test_edges`), must
// look at in double, with their jumps where floats are sure of them. Both go over arrays of floats, so that
// compilers make vectors of them, and dismiss an edge only with a margin that covers rounding.
//
// Margins: coordinates start at the tile's middle. An edge whose ends are at most s from there has
// coordinates off by 2^-24 s. M is the extent of the scene in light radii.
//  - `narrow` asks what shaft.h asks, for fewer receivers. An edge is dismissed where it lies
//    2^-19 (M + s)(1 + |slope|) beyond a side of the shaft, or where both faces are on the same side for all
//    receivers.
//  - `test_edges` asks for one receiver x. With w = x.z - p.z and g = x.z/w, projection makes errors of at
//    most 2^-24 (s g)(2 + s/w) times a small number, plus 2^-24 M for x itself. An edge is dismissed where it
//    stays 2^-19 (M + s g (1 + s/w)) outside of the disk, w the smaller one of its ends. It is also dismissed
//    where the values of both planes are beyond their tolerances and 2^-20 of the terms of the sums, and the
//    jump is 0.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette/collect/shaft.h"

namespace penumbra::detail {

/// A tile's edges, or some of them for a part of the tile.
class EdgeList {
 public:
  /// A tile's list: edges of the band by their indices. `middle`: where coordinates in float start. Refers
  /// to the band. Cost O(edges).
  void assign(const Band& band, std::span<const std::uint32_t> edges, const Vec3& middle);
  /// Some edges of another list, by their indices in it, with the same middle. Refers to the tile's list.
  /// Cost O(indices).
  void assign(const EdgeList& list, std::span<const std::uint32_t> indices);

  std::size_t size() const { return places_.size(); }
  /// The place of edge i in the tile's list; `edge` and `ends` go by places.
  std::int32_t place(std::size_t i) const { return places_[i]; }
  const std::int32_t* places() const { return places_.data(); }
  const BandEdge& edge(std::int32_t place) const { return *tile().edges_[static_cast<std::size_t>(place)]; }
  /// Six numbers a place: a and b in the light's frame.
  const double* ends() const { return tile().ends_.data(); }
  const Vec3& middle() const { return middle_; }
  double extent() const { return extent_; }
  std::size_t bytes() const;

  /// Numbers in float, an array each: the ends, their largest coordinate, the planes with offset and
  /// tolerance.
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

  /// The tile's list if this is a part of it, else null.
  const EdgeList* tile_ = nullptr;
  /// Of a tile's list only.
  std::vector<const BandEdge*> edges_;
  std::vector<double> ends_;
  std::vector<std::int32_t> places_;
  std::array<std::vector<float>, kColumns> columns_;
  Vec3 middle_{0.0};
  double extent_ = 1.0;
};

/// The indices of the edges that some receiver of the shaft must look at, ascending. Replaces `out`. Cost:
/// some 270 flops an edge.
void narrow(const EdgeList& list, const Shaft& shaft, std::vector<std::uint32_t>& out);

/// What the edge test leaves for one receiver. Arrays may be longer than their counts.
struct TestedEdges {
  static constexpr std::int32_t kUnsure = 127;
  /// Edges: their places in a list or indices in a band, and their jumps, or kUnsure where floats do not
  /// tell.
  std::size_t count = 0;
  std::vector<std::int32_t> places;
  std::vector<std::int32_t> jumps;
  /// The blocks whose edges were tested (EdgeBlocks).
  std::size_t looked_into = 0;
  std::vector<std::int32_t> blocks;
};

/// The edges that a receiver at x must look at, in the order of the list. Cost: some 70 flops an edge.
/// Compiled for several instruction sets with the same result.
void test_edges(const EdgeList& list, const Vec3& x, TestedEdges& out);
/// The same for edge i of the list alone: 0 where it is dismissed, else its jump. For tests.
int test_edge(const EdgeList& list, std::size_t i, const Vec3& x);

}  // namespace penumbra::detail
