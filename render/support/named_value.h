// Words of the command line and of --stats, and the values they stand for.
#pragma once

#include <span>

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

}  // namespace penumbra
