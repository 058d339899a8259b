// Stratified samples of the unit square and the unit disk, the same for every machine and thread count.
#pragma once

#include <bit>
#include <cstdint>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// A 32-bit integer mix with low bias: three xor-shifts and two multiplications (constants found by C.
/// Wellons' search).
inline std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

inline float unit_float(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

struct DiskPoint {
  float x, y;
};

/// Shirley and Chiu's concentric map of the unit square to the unit disk (1997): equal areas to equal areas.
/// The sine and cosine of an angle in [-π/4, π/4] are Taylor sums good to float precision, so that loops over
/// it vectorise.
inline DiskPoint concentric_disk(float s, float t) {
  const float a = 2.0f * s - 1.0f, b = 2.0f * t - 1.0f;
  const bool wide = a * a > b * b;
  const float radius = wide ? a : b;
  const float other = wide ? b : a;
  const float angle = radius != 0.0f ? 0.785398163f * other / radius : 0.0f;
  const float q = angle * angle;
  const float sine =
      angle * (1.0f + q * (-1.0f / 6 + q * (1.0f / 120 + q * (-1.0f / 5040 + q * (1.0f / 362880)))));
  const float cosine = 1.0f + q * (-1.0f / 2 + q * (1.0f / 24 + q * (-1.0f / 720 + q * (1.0f / 40320))));
  return wide ? DiskPoint{radius * cosine, radius * sine} : DiskPoint{radius * sine, radius * cosine};
}

/// `rows` × `columns` strata; sample i lies in stratum (i mod columns, i / columns).
struct Strata {
  explicit Strata(int samples) {
    while ((rows + 1) * (rows + 1) <= samples) ++rows;
    columns = (samples + rows - 1) / rows;
  }
  int count() const { return rows * columns; }
  int rows = 1, columns = 1;
};

/// Sample `i` of the pixel whose stream is `key`, in the unit square.
inline DiskPoint stratum_sample(std::uint32_t key, std::uint32_t i, float column, float row, float per_column,
                                float per_row) {
  const std::uint32_t h = mix(key + i * 0x9e3779b9u);
  const float s = (column + unit_float(h)) * per_column;
  const float t = (row + unit_float(mix(h ^ 0x68bc21ebu))) * per_row;
  return {s, t};
}

/// The same on the unit disk.
inline DiskPoint disk_sample(std::uint32_t key, std::uint32_t i, float column, float row, float per_column,
                             float per_row) {
  const DiskPoint p = stratum_sample(key, i, column, row, per_column, per_row);
  return concentric_disk(p.x, p.y);
}

/// The stream of a pixel: differs in every bit with seed and pixel.
inline std::uint32_t sample_key(std::uint64_t seed, std::uint32_t pixel) {
  return mix(mix(pixel + 0x51633e2du) ^ mix(static_cast<std::uint32_t>(seed) * 0x2c1b3c6du +
                                            static_cast<std::uint32_t>(seed >> 32) + 0x297a2d39u));
}

/// The stream of a point in the world.
inline std::uint32_t sample_key(std::uint64_t seed, const Vec3& point) {
  std::uint32_t h = 0x9e3779b9u;
  for (int k = 0; k < 3; ++k) {
    const auto bits = std::bit_cast<std::uint64_t>(point[k] + 0.0);  // +0 for -0
    h = mix(h ^ static_cast<std::uint32_t>(bits)) + static_cast<std::uint32_t>(bits >> 32);
    h = mix(h);
  }
  return sample_key(seed, h);
}

}  // namespace penumbra::detail
