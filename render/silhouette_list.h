// Accurate rung, between steps 2 and 3: a tile's edges in float, and what dismisses most of them cheaply.
//
// In: a tile's edges. Out: those that some of its receivers, or one of them, must look at in double. Both
// passes go over arrays of floats and vectorise; they dismiss an edge only with a margin that covers
// rounding. In coordinates that start at the tile's middle an edge whose ends are at most s from there has
// coordinates off by 2^-24 s; M is the scene's extent in light radii.
//
// `narrow` asks the questions of silhouette_gather.h again, for fewer receivers: an edge is dismissed where
// it lies 2^-19 (M + s)(1 + |slope|) beyond a plane of the shaft, or where its faces keep their sides.
//
// `sift` asks for one receiver x: projection with w = x.z - p.z, g = x.z/w makes errors at most 2^-24 (s g)(2
// + s/w) times a small number, plus 2^-24 M for x itself. An edge is dismissed where it stays 2^-19 (M + s g
// (1 + s/w)) outside of the disk, w the smaller one of its ends, or where both faces keep their sides by the
// planes' tolerances and 2^-20 of the sum's terms.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette_gather.h"

namespace penumbra::detail {

class EdgeList {
 public:
  /// `middle`: where the float coordinates start. Cost O(edges).
  void assign(const Band& band, std::span<const std::uint32_t> edges, const Vec3& middle);
  /// Some of another list's edges, by their places in it, with the same middle.
  void assign(const EdgeList& list, std::span<const std::uint32_t> places);

  std::size_t size() const { return edges_.size(); }
  const BandEdge& operator[](std::size_t i) const { return *edges_[i]; }
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
  void fill_columns();
  void fill_plane(const FacePlane& plane, std::size_t i, Column first);

  std::vector<const BandEdge*> edges_;
  std::array<std::vector<float>, kColumns> columns_;
  Vec3 middle_{0.0};
  double extent_ = 1.0;
};

/// Places of the edges that some receiver of the shaft must look at, ascending. Cost: some 200 flops an edge.
void narrow(const EdgeList& list, const Shaft& shaft, std::vector<std::uint32_t>& out);

/// Places of the edges that a receiver at x must look at, ascending. Cost: some 70 flops an edge. Compiled
/// for several instruction sets with the same result.
void sift(const EdgeList& list, const Vec3& x, std::vector<std::uint32_t>& out);
/// Whether edge `i` is kept, computed for it alone without vectors: what tests compare with.
bool sift_one(const EdgeList& list, std::size_t i, const Vec3& x);

}  // namespace penumbra::detail
