// What a method counted while it made a frame: faces, entries, bytes. Names and values, ready to be shown.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace penumbra {

/// One figure of a frame and its name. An integer is a number of things or bytes, a double is a length in
/// scene units, a string is a word in place of a number.
struct Count {
  std::string name;
  std::variant<std::uint64_t, double, std::string> value;
};

/// In no particular order; every name occurs once.
using Counts = std::vector<Count>;

/// The count of that name; null if there is none. Cost O(counts).
inline const Count* find(const Counts& counts, std::string_view name) {
  const auto it = std::ranges::find(counts, name, &Count::name);
  return it == counts.end() ? nullptr : &*it;
}

}  // namespace penumbra
