// Words of options and the values that they stand for.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

template <class Value>
struct NamedValue {
  Value value;
  const char* name;
};

template <class Value>
const char* name_in(std::span<const NamedValue<Value>> names, Value value) {
  for (const auto& n : names)
    if (n.value == value) return n.name;
  return "?";
}

/// The word must be one of the names.
template <class Value>
Value value_in(std::span<const NamedValue<Value>> names, std::string_view word) {
  for (const auto& n : names)
    if (n.name == word) return n.value;
  throw std::logic_error("no value is called " + std::string(word));
}

template <class Value>
std::vector<std::string> words_of(std::span<const NamedValue<Value>> names) {
  std::vector<std::string> words;
  for (const auto& n : names) words.emplace_back(n.name);
  return words;
}

}  // namespace penumbra
