#include "penumbra/render/solids/light_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

#include "penumbra/mesh/error.h"
#include "penumbra/volumes/volumes.h"
#include "render/casters_impl.h"
#include "render/solids/tiled_points.h"
#include "volumes/solids/shafts/shadow_box.h"

namespace penumbra {
namespace {

constexpr int kBlock = 4;  // points a side
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

std::vector<std::size_t> blocks_to_judge(const Blocks& blocks, const detail::LitBoxes& boxes,
                                         const CircularLight& light) {
  std::vector<char> lit(blocks.count(), 0);
  tbb::parallel_for(std::size_t{0}, lit.size(), [&](std::size_t b) {
    Bounds box;
    bool in_front = true;
    blocks.for_each(b, [&](int i, int j, int k) {
      box.add(blocks.point(i, j, k));
      in_front = in_front && !is_behind(light, blocks.point(i, j, k));
    });
    lit[b] = in_front && boxes.is_lit(box) ? 1 : 0;
  });
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < lit.size(); ++b)
    if (!lit[b]) out.push_back(b);
  return out;
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
    std::vector<Vec3> points;
    for (std::size_t b = first; b < last; ++b)
      blocks.for_each(which[b], [&](int i, int j, int k) { points.push_back(blocks.point(i, j, k)); });
    const std::vector<float> seen = detail::seen_from(casters, light, points);
    std::size_t next = 0;
    for (std::size_t b = first; b < last; ++b)
      blocks.for_each(which[b], [&](int i, int j, int k) {
        if (blocks.has(i, j, k)) out.seen[blocks.index(i, j, k)] = seen[next];
        ++next;
      });
    report(progress, static_cast<double>(last) / static_cast<double>(which.size()));
  }
  return out;
}

}  // namespace penumbra
