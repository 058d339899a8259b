// bake: parts of a bake, done by this process or by the ranks of an MPI run.
#pragma once

#include <functional>
#include <vector>

#include "apps/cli/bake/part_store.h"
#include "apps/cli/ranks/ranks.h"
#include "penumbra/mesh/progress.h"

namespace penumbra::apps {

struct BakeParts {
  std::size_t count = 0;
  /// How many values a part has, and what it costs, in any unit.
  std::function<std::size_t(std::size_t)> values;
  std::function<double(std::size_t)> cost;
  std::function<std::vector<float>(std::size_t, const Progress&)> bake;
};

/// Rank 0, or a process alone (`ranks` is null): all parts that the store has not. Returns how many it had.
std::size_t bake_all(const BakeParts& parts, const PartStore& store, Ranks* ranks, const Progress& progress);

/// Any other rank.
void help(const BakeParts& parts, Ranks& ranks);

}  // namespace penumbra::apps
