// A hash set of indices that answers "which index had this key first?", for welding positions and finding
// duplicates.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra::detail {

/// Open addressing with linear probing; at most half full.
class FirstIndex {
 public:
  explicit FirstIndex(std::size_t capacity)
      : slots_(std::bit_ceil(2 * capacity + 1), kEmpty), mask_(slots_.size() - 1) {}

  /// The first index inserted with an equal key, which is `candidate` itself where there was none. `same(i)`
  /// compares the candidate's key with that of i.
  template <class Same>
  std::uint32_t find_or_insert(std::uint64_t hash, std::uint32_t candidate, Same same) {
    for (std::size_t at = hash & mask_;; at = (at + 1) & mask_) {
      if (slots_[at] == kEmpty) {
        slots_[at] = candidate;
        return candidate;
      }
      if (same(slots_[at])) {
        return slots_[at];
      }
    }
  }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> slots_;
  std::size_t mask_;
};

/// Adds 64 bits to a running hash: multiply and xor-shift, so that high bits reach the low ones a table looks
/// at.
inline std::uint64_t mix(std::uint64_t hash, std::uint64_t bits) {
  hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
  hash = (hash ^ (hash >> 32)) * 0xD6E8FEB86659FD93u;
  return hash ^ (hash >> 29);
}

}  // namespace penumbra::detail
