// study --peers: POV-Ray's circular area light, on the same pixels.
//
// The scene is written as POV-Ray's meshes, white and diffuse, without ambient light, and rendered twice: with shadows, and
// with a light that throws none. POV-Ray shades by the light's center and multiplies by the part of the n × n lights of its
// area light that a point sees, so that the ratio of the two pictures is that part: visibility, but that the horizon counts for
// the center alone. Both are linear, 16 bits. n × n are its samples; they are the same at every pixel, so errors show as bands.
#pragma once

#include <optional>
#include <vector>

#include "apps/cli/study/measure.h"

namespace penumbra::apps {

/// Shadowed over unshadowed, one a pixel, of 16-bit values: 0 where the unshadowed picture is dark.
std::vector<float> visibility_of_ratio(const std::vector<unsigned>& shadowed,
                                       const std::vector<unsigned>& unshadowed);

/// Whether `povray` can be run.
bool has_povray();

/// Its settings: samples 16 and 64; more take seconds.
std::vector<Setting> povray_settings();

/// Nothing where the light is not a disk, or where POV-Ray fails. `unshadowed` is a picture of the case whose channel
/// `visibility` is replaced. Times are what POV-Ray says of tracing, one a round.
std::optional<Measured> measure_povray(const StudyCase& seen, const Setting& setting, int rounds, int threads,
                                       const Image& unshadowed);

}  // namespace penumbra::apps
