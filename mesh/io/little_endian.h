// Binary numbers as files have them: least significant byte first, on any machine.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace penumbra::detail {

template <class T>
void append_little_endian(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace penumbra::detail
