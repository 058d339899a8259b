#include "penumbra/render/solids/light_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <string>

#include "penumbra/mesh/error.h"
#include "penumbra/volumes/volumes.h"
#include "render/casters_impl.h"
#include "render/solids/tiled_points.h"
#include "volumes/solids/shafts/shadow_box.h"

namespace penumbra {
namespace {

constexpr int kBlock = 4;  // points a side
constexpr std::size_t kPoints = kBlock * kBlock * kBlock;
constexpr int kGroup = 4;  // blocks a side that are first tried together
constexpr int kMostCount = 2048;
constexpr std::size_t kBatch = 1u << 15;  // blocks that are judged by one call

/// The blocks of a field, and the points of each.
class Blocks {
 public:
  explicit Blocks(const LightField& field) : field_(field) {
    for (int k = 0; k < 3; ++k) blocks_[k] = (field.counts[k] + kBlock - 1) / kBlock;
  }
  std::size_t count() const {
    return static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1]) *
           static_cast<std::size_t>(blocks_[2]);
  }
  const std::array<int, 3>& along() const { return blocks_; }
  std::size_t block_at(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(blocks_[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(blocks_[0]) +
           static_cast<std::size_t>(x);
  }
  /// Calls visit(i, j, k) for all of its 64 places, some of which may lie beyond the field.
  template <class Visit>
  void for_each(std::size_t block, const Visit& visit) const {
    const auto b = static_cast<int>(block);
    const int x = b % blocks_[0] * kBlock, y = b / blocks_[0] % blocks_[1] * kBlock,
              z = b / blocks_[0] / blocks_[1] * kBlock;
    for (int k = 0; k < kBlock; ++k)
      for (int j = 0; j < kBlock; ++j)
        for (int i = 0; i < kBlock; ++i) visit(x + i, y + j, z + k);
  }
  bool has(int i, int j, int k) const {
    return i < field_.counts[0] && j < field_.counts[1] && k < field_.counts[2];
  }
  Vec3 point(int i, int j, int k) const { return field_.origin + field_.step * Vec3(i, j, k); }
  std::size_t index(int i, int j, int k) const {
    const auto nx = static_cast<std::size_t>(field_.counts[0]),
               ny = static_cast<std::size_t>(field_.counts[1]);
    return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx +
           static_cast<std::size_t>(i);
  }

 private:
  const LightField& field_;
  std::array<int, 3> blocks_{};
};

/// Whether no place of the blocks from `low` to before `high` is hidden from any of the light. Behind the
/// light nothing is lit.
bool are_lit(const Blocks& blocks, const std::array<int, 3>& low, const std::array<int, 3>& high,
             const detail::LitBoxes& boxes, const CircularLight& light) {
  Bounds box;
  bool in_front = true;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = [&](int k) { return (corner >> k & 1) != 0 ? kBlock * high[k] - 1 : kBlock * low[k]; };
    const Vec3 p = blocks.point(at(0), at(1), at(2));
    box.add(p);
    in_front = in_front && !is_behind(light, p);
  }
  return in_front && boxes.is_lit(box);
}

std::vector<std::size_t> blocks_to_judge(const Blocks& blocks, const detail::LitBoxes& boxes,
                                         const CircularLight& light) {
  std::vector<char> lit(blocks.count(), 0);
  const std::array<int, 3>& n = blocks.along();
  const auto groups = [&](int k) { return (n[k] + kGroup - 1) / kGroup; };
  tbb::parallel_for(0, groups(0) * groups(1) * groups(2), [&](int g) {
    const std::array<int, 3> low{g % groups(0) * kGroup, g / groups(0) % groups(1) * kGroup,
                                 g / groups(0) / groups(1) * kGroup};
    std::array<int, 3> high;
    for (int k = 0; k < 3; ++k) high[k] = std::min(low[k] + kGroup, n[k]);
    const bool all = are_lit(blocks, low, high, boxes, light);
    for (int z = low[2]; z < high[2]; ++z)
      for (int y = low[1]; y < high[1]; ++y)
        for (int x = low[0]; x < high[0]; ++x)
          lit[blocks.block_at(x, y, z)] =
              all || are_lit(blocks, {x, y, z}, {x + 1, y + 1, z + 1}, boxes, light) ? 1 : 0;
  });
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < lit.size(); ++b)
    if (!lit[b]) out.push_back(b);
  return out;
}

/// Judges all points of the blocks.
void judge(const Casters& casters, const LightShape& light, const Blocks& blocks,
           std::span<const std::size_t> which, LightField& out) {
  tbb::task_arena& threads = *casters.impl().threads;
  std::vector<Vec3> points(kPoints * which.size());
  const auto for_each = [&](const auto& visit) {
    threads.execute([&] {
      tbb::parallel_for(std::size_t{0}, which.size(), [&](std::size_t b) {
        std::size_t n = kPoints * b;
        blocks.for_each(which[b], [&](int i, int j, int k) { visit(n++, i, j, k); });
      });
    });
  };
  for_each([&](std::size_t n, int i, int j, int k) { points[n] = blocks.point(i, j, k); });
  const std::vector<float> seen = detail::seen_from(casters, light, points);
  for_each([&](std::size_t n, int i, int j, int k) {
    if (blocks.has(i, j, k)) out.seen[blocks.index(i, j, k)] = seen[n];
  });
}

}  // namespace

LightField light_field(const Casters& casters, const LightShape& light, const Bounds& box,
                       const std::array<int, 3>& counts, const Progress& progress) {
  const CircularLight circular = require_circular(light, "fields");
  require_valid(circular);
  LightField out;
  out.counts = counts;
  out.origin = box.low;
  std::size_t total = 1;
  for (int k = 0; k < 3; ++k) {
    if (counts[k] < 2 || counts[k] > kMostCount)
      throw UsageError("a field has 2 to " + std::to_string(kMostCount) + " points along each axis");
    if (!(box.low[k] < box.high[k])) throw UsageError("the box of a field is empty");
    out.step[k] = (box.high[k] - box.low[k]) / (counts[k] - 1);
    total *= static_cast<std::size_t>(counts[k]);
  }
  out.seen.assign(total, 1.0f);
  const std::vector<TriangleMesh> meshes = detail::casting_meshes(casters);
  const detail::CasterTree tree(meshes, circular);
  const detail::LitBoxes boxes(tree, circular, box);
  const Blocks blocks(out);
  const std::vector<std::size_t> which =
      casters.impl().threads->execute([&] { return blocks_to_judge(blocks, boxes, circular); });
  for (std::size_t first = 0; first < which.size(); first += kBatch) {
    const std::size_t last = std::min(which.size(), first + kBatch);
    judge(casters, light, blocks, std::span(which).subspan(first, last - first), out);
    report(progress, static_cast<double>(last) / static_cast<double>(which.size()));
  }
  return out;
}

}  // namespace penumbra
