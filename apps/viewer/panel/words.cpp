#include "apps/viewer/panel/words.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <utility>

namespace penumbra::viewer {
namespace {

using Words = std::pair<const char*, const char*>;

constexpr Words kMethods[] = {{"silhouette", "Silhouette"},
                              {"dbuffer", "D-buffer"},
                              {"occlusion-textures", "Occlusion textures"},
                              {"reference", "Reference"},
                              {"rays", "Rays where uncertain"},
                              {"pcss", "PCSS"},
                              {"hard", "Hard shadow"},
                              {"none", "No shadow"}};

constexpr Words kOptions[] = {{"silhouette-rows", "Scanlines"},
                              {"silhouette-tolerance", "Tolerance"},
                              {"dbuffer-size", "Texture size"},
                              {"dbuffer", "A texel keeps"},
                              {"dbuffer-entries", "Entries a texel"},
                              {"visibility", "Visibility curve"},
                              {"conflict", "Of several, keep"},
                              {"dbuffer-center", "Center hidden by"},
                              {"dbuffer-check", "Check by rays"},
                              {"backend", "OpenGL by"},
                              {"samples", "Rays a pixel"},
                              {"seed", "Seed"},
                              {"texture-size", "Texture size"},
                              {"filter", "Filter"},
                              {"combine", "Slices add up by"},
                              {"kernel", "Light as"},
                              {"thin-fix", "Thin objects"},
                              {"slice-range", "Sliced depths"},
                              {"coverage", "Texel coverage"},
                              {"slice-faces", "Drawn faces"},
                              {"cop-offset", "Projection center"}};

std::string words_in(std::span<const Words> table, const std::string& name) {
  for (const auto& [from, to] : table)
    if (name == from) return to;
  std::string words = name;
  std::ranges::replace(words, '-', ' ');
  if (!words.empty()) words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words;
}

// 0 lies outside of the range and has a meaning of its own.
bool zero_is_auto(const OptionSchema& option) {
  const auto* range = std::get_if<IntegerRange>(&option.domain);
  return range && range->low > 0 && std::ranges::count(range->also, 0u) > 0;
}

}  // namespace

std::string words_of_method(const std::string& name) {
  return words_in(kMethods, name);
}

std::string words_of_option(const std::string& name) {
  return words_in(kOptions, name);
}

std::string shown_value(const OptionSchema& option, const std::string& value) {
  return value == "0" && zero_is_auto(option) ? "auto" : value;
}

std::string help_of(const OptionSchema& option) {
  std::string text =
      option.help + ".\nAllowed: " + option.allowed() + ". Usual: " + to_text(option.usual) + ".";
  if (!zero_is_auto(option)) return text;
  for (const auto& [zero, word] : {std::pair("; 0: ", "; auto: "),
                                   {"Allowed: 0 or ", "Allowed: auto or "},
                                   {"Usual: 0.", "Usual: auto."}})
    if (const std::size_t at = text.find(zero); at != std::string::npos)
      text.replace(at, std::string_view(zero).size(), word);
  return text;
}

std::string value_from_shown(const OptionSchema& option, const std::string& shown) {
  return shown == "auto" && zero_is_auto(option) ? "0" : shown;
}

std::string with_commas(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

}  // namespace penumbra::viewer
