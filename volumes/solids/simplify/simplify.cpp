#include "volumes/solids/simplify/simplify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

#include "volumes/solids/simplify/box_collapses.h"

namespace penumbra::detail {
namespace {

/// Speed: a box holds at most so many vertices.
constexpr std::size_t kMostVertices = 6'000;
/// Where boxes are cut: each pass elsewhere, since nothing collapses where they meet.
constexpr std::array<double, 4> kShares{0.5, 0.37, 0.61, 0.45};
/// Another pass over all edges follows where one took away more than this share of the triangles.
constexpr double kFewer = 0.01;

std::size_t pass_over(ChangingSurface& surface, double share, const Progress& progress) {
  std::vector<std::uint32_t> left;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v)
    if (!surface.faces_at[v].empty()) left.push_back(v);
  const DisjointBoxes boxes(surface.positions, std::move(left), kMostVertices, share);
  BoxedSurface all = boxed(surface, boxes);
  std::mutex mutex;
  std::size_t collapsed = 0, done = 0;
  tbb::parallel_for(std::size_t{0}, boxes.count(), [&](std::size_t i) {
    const std::size_t here = BoxCollapses(all, static_cast<std::uint32_t>(i)).run();
    const std::lock_guard lock(mutex);
    collapsed += here;
    report(progress, static_cast<double>(++done) / static_cast<double>(boxes.count()));
  });
  return collapsed;
}

}  // namespace

IndexedSurface simplify(IndexedSurface surface, const SimplifyOptions& options) {
  const auto least = static_cast<std::size_t>(kFewer * static_cast<double>(surface.triangles.size()));
  ChangingSurface changing(std::move(surface), options);
  double from = 0.0;
  for (const double share : kShares) {
    const double to = 0.5 * (1.0 + from);
    if (pass_over(changing, share, part_of(options.progress, from, to)) < std::max<std::size_t>(least, 1))
      break;
    from = to;
  }
  return changing.result();
}

}  // namespace penumbra::detail
