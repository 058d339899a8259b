// The machine that figures were measured on.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

namespace penumbra::apps {

/// "processor", "cores" and "instruction_set", the widest vectors that it has.
nlohmann::json describe_machine();

/// Largest resident size of this process so far; 0 where the system does not say.
std::size_t peak_memory_bytes();

}  // namespace penumbra::apps
