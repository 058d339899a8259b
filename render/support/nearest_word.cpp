#include "render/support/nearest_word.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace penumbra {
namespace {

std::string in_lower_case(std::string_view word) {
  std::string lower(word);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

/// Optimal string alignment (Damerau 1964, Levenshtein 1966): row by row, three rows kept.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, std::span<const std::string> known) {
  constexpr std::size_t kLongest = 64;  // no known word is as long
  const std::string given = in_lower_case(word);
  if (given.empty() || given.size() > kLongest) return {};
  std::string nearest;
  std::size_t least = kLongest;
  for (const std::string& each : known) {
    const std::string other = in_lower_case(each);
    const std::size_t edits = other.starts_with(given) ? 0 : distance(given, other);
    if (edits >= least || edits > (std::max(given.size(), other.size()) + 2) / 3) continue;
    least = edits;
    nearest = each;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
  const std::string nearest = nearest_word(word, known);
  return nearest.empty() ? "" : " (did you mean " + nearest + "?)";
}

}  // namespace penumbra
