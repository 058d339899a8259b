#include "render/silhouette_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace penumbra::detail {
namespace {

using Block = EdgeBlocks::Block;
using Plane = EdgeBlocks::Plane;

struct FloatPoint {
  explicit FloatPoint(const Vec3& p)
      : x(static_cast<float>(p.x)), y(static_cast<float>(p.y)), z(static_cast<float>(p.z)) {}
  float x, y, z;
};

PENUMBRA_INLINE void value_at(const FloatPoint& p, const Plane& plane, Floats& out) {
  out = plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.offset;
}

/// The jumps of eight edges: 0 where dismissed.
PENUMBRA_INLINE void jumps_of(const Block& b, const FloatPoint& p, Ints& out) {
  Floats left, right;
  value_at(p, b.left, left);
  value_at(p, b.right, right);
  const Ints none{}, unsure = none + Sifted::kUnsure;
  const Ints sure = (magnitude(left) > b.left.tolerance) & (magnitude(right) > b.right.tolerance);
  // Comparisons are -1 where true.
  const Ints jump = -1 - 2 * (left > 0.0f) + (right > 0.0f) - (right < 0.0f);
  out = sure ? jump : unsure;
}

PENUMBRA_VECTOR_CLONES
std::size_t sift_blocks(const Block* blocks, const Siblings* list, std::size_t count, const FloatPoint& at,
                        std::int32_t* places, std::int32_t* jumps) {
  const FloatPoint p = at;
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::uint32_t kept = list[i].kept; kept != 0; kept &= kept - 1) {
      const std::uint32_t block =
          list[i].parent * kFloatLanes + static_cast<std::uint32_t>(std::countr_zero(kept));
      Ints jump;
      jumps_of(blocks[block], p, jump);
      for (std::uint32_t edges = bits_of(jump != 0); edges != 0; edges &= edges - 1) {
        const int lane = std::countr_zero(edges);
        places[found] = static_cast<std::int32_t>(block) * kFloatLanes + lane;
        jumps[found++] = jump[lane];
      }
    }
  return found;
}

}  // namespace

EdgeBlocks::EdgeBlocks(const Band& band)
    : band_(band),
      size_((band.edges.size() + kFloatLanes - 1) / kFloatLanes),
      blocks_(std::make_unique_for_overwrite<Block[]>(size_)) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size_, 512), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) fill(i);
  });
}

/// A face that is missing has value 0 and tolerance -1: surely on neither side. Lanes without an edge lie
/// between two faces that look the same way.
void EdgeBlocks::fill(std::size_t block) {
  const auto set = [&](Plane& out, std::size_t lane, const FacePlane& plane) {
    const double grain = 0x1p-20 * (std::abs(plane.offset) + 4.0 * band_.extent);
    out.x[lane] = static_cast<float>(plane.normal.x);
    out.y[lane] = static_cast<float>(plane.normal.y);
    out.z[lane] = static_cast<float>(plane.normal.z);
    out.offset[lane] = static_cast<float>(plane.offset);
    out.tolerance[lane] = plane.tolerance < 0.0 ? -1.0f : static_cast<float>(plane.tolerance + grain);
  };
  const FacePlane front{Vec3(0.0), 1.0, -1.0};
  for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
    const std::size_t i = block * kFloatLanes + lane;
    const bool is_edge = i < band_.edges.size();
    set(blocks_[block].left, lane, is_edge ? band_.edges[i].left : front);
    set(blocks_[block].right, lane, is_edge ? band_.edges[i].right : front);
  }
}

void EdgeBlocks::sift(const std::vector<Siblings>& list, const Vec3& x, Sifted& out) const {
  std::size_t most = 0;
  for (const Siblings& s : list) most += static_cast<std::size_t>(std::popcount(s.kept)) * kFloatLanes;
  out.places.resize(most);
  out.jumps.resize(most);
  const std::size_t found = sift_blocks(blocks_.get(), list.data(), list.size(), FloatPoint(x),
                                        out.places.data(), out.jumps.data());
  out.places.resize(found);
  out.jumps.resize(found);
}

int EdgeBlocks::sift_one(std::size_t i, const Vec3& x) const {
  Ints jump;
  jumps_of(blocks_[i / kFloatLanes], FloatPoint(x), jump);
  return jump[i % kFloatLanes];
}

}  // namespace penumbra::detail
