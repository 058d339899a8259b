// Which known word somebody probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace penumbra {

/// The word of `known` that takes the fewest letters added, left out, changed or swapped with the next one to
/// make of `word`, whatever the case; one that begins with `word` takes none. The first of several. Empty
/// where it takes more than a third of the longer word's letters, rounded up.
std::string nearest_word(std::string_view word, std::span<const std::string> known);

/// " (did you mean silhouette?)", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace penumbra
