// study --peers: scripts of ours that other programs run.
#pragma once

#include <string_view>

namespace penumbra::apps {

/// A file of apps/cli/study/peers by its name.
std::string_view peer_text(std::string_view name);

}  // namespace penumbra::apps
