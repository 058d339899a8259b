// study --peers: three.js with percentage-closer soft shadows (PCSS) in headless Chromium, on the same
// pixels.
//
// threejs.js makes the scene in three.js (npm's package three): white, Lambert, flat faces, a spot light at
// the disk's center or a directional light for a sun, with a shadow map that just holds the casters. In place
// of three.js's filter stands PCSS (Fernando 2005), as its example webgl_shadowmap_pcss does it: a search for
// blockers, the penumbra's width from their mean depth, a filter of that width. The disk's radius is the
// light's size. V is the ratio of a frame with and one without shadows, in float.
#pragma once

#include <filesystem>

#include "apps/cli/study/peers/peer.h"

namespace penumbra::apps {

/// `three` is the folder of npm's package three; empty: the peer cannot be run. Settings: the example's map
/// of 1,024² and 17 samples for the search and twice as many for the filter; a map of 4,096²; and that with
/// 64 samples. Times are of render and waiting for a pixel, the map drawn again, in Chromium's SwiftShader:
/// they say nothing of a GPU. As many frames as fit in some seconds, at most the case's rounds.
Peer threejs_peer(const std::filesystem::path& three);

}  // namespace penumbra::apps
