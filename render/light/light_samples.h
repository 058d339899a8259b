// The points of a light at which a receiver looks: jittered strata of equal area, the same for every method
// that samples.
//
// In: a stream of random numbers (disk_samples.h) and how many samples. Out: points of the unit disk, by the
// concentric map of Shirley and Chiu (1997), or of the square [-1, 1]², sixteen at a time.
#pragma once

#include <vector>

#include "render/light/disk_samples.h"
#include "render/support/vector_clones.h"

namespace penumbra::detail {

/// How many samples are placed at once.
inline constexpr int kSampleLanes = 16;

/// Where each sample's stratum lies, so that no lane divides.
struct StratumTable {
  /// `samples` is rounded up to ⌊√N⌋ rows of equal length; the arrays to whole lanes.
  explicit StratumTable(int samples) : strata(samples) {
    const int padded = (strata.count() + kSampleLanes - 1) / kSampleLanes * kSampleLanes;
    for (int i = 0; i < padded; ++i) {
      const int column = i % strata.columns, row = i / strata.columns;
      columns.push_back(static_cast<float>(column));
      rows.push_back(static_cast<float>(row));
    }
  }
  Strata strata;
  std::vector<float> columns, rows;
};

/// Samples first to first + 15 of a stream: on the unit disk, or in the square. For loops that are compiled
/// for several instruction sets.
PENUMBRA_INLINE void place_samples(const StratumTable& table, bool disk, std::uint32_t key, int first,
                                   float* a, float* b) {
  const float per_column = 1.0f / static_cast<float>(table.strata.columns);
  const float per_row = 1.0f / static_cast<float>(table.strata.rows);
  const float* columns = table.columns.data() + first;
  const float* rows = table.rows.data() + first;
  for (int k = 0; k < kSampleLanes; ++k) {
    const DiskPoint p =
        stratum_sample(key, static_cast<std::uint32_t>(first + k), columns[k], rows[k], per_column, per_row);
    a[k] = p.x;
    b[k] = p.y;
  }
  if (disk)
    for (int k = 0; k < kSampleLanes; ++k) {
      const DiskPoint p = concentric_disk(a[k], b[k]);
      a[k] = p.x;
      b[k] = p.y;
    }
  else
    for (int k = 0; k < kSampleLanes; ++k) {
      a[k] = 2.0f * a[k] - 1.0f;
      b[k] = 2.0f * b[k] - 1.0f;
    }
}

}  // namespace penumbra::detail
