// study: bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace penumbra::apps {

/// RFC 4648, with padding.
std::string base64_of(std::string_view bytes);
/// Back again. Characters that are none of its letters are left out.
std::string from_base64(std::string_view text);

}  // namespace penumbra::apps
