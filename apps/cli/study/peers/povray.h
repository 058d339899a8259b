// study --peers: POV-Ray's circular area light, on the same pixels.
//
// The scene is written as POV-Ray's meshes, white and diffuse, without ambient light, and rendered twice:
// with shadows, and with a light that throws none. POV-Ray shades by the light's center and multiplies by the
// part of the n × n lights of its area light that a point sees, so that the ratio of the two pictures is that
// part: visibility, but that the horizon counts for the center alone. Both are linear, 16 bits. n × n are its
// samples; they are the same at every pixel, so errors show as bands.
#pragma once

#include "apps/cli/study/peers/peer.h"

namespace penumbra::apps {

/// Settings: samples 16 and 64; more take seconds. Times are what POV-Ray says of tracing, one a round.
Peer povray_peer();

}  // namespace penumbra::apps
