// study, step 2: frames of several settings, timed in turn.
//
// What is compared is run in turn: in every round each setting draws one frame, and the default method one
// beside it, so that a busy minute falls on all of them and ratios are of pairs. Before a timed frame of less
// than 150 ms the same frame is drawn once without being timed, since buffers and caches were another
// setting's. Of frames of more than 2 s the first is the one that is timed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/cli/study/measure/too_long.h"
#include "apps/cli/study/settings.h"
#include "apps/cli/study/study_case.h"
#include "penumbra/render/renderer.h"

namespace penumbra::apps {

struct Measured {
  /// Milliseconds of whole frames, one a round.
  std::vector<double> frames;
  /// The same over the default method's frame of the same round.
  std::vector<double> over_default;
  /// Medians.
  StageTimes stages;
  Image image;
  std::vector<float> visibility;
  std::vector<std::int8_t> region;
  std::string renderer;
  Counts counts;
  /// Set where the method refused, or the setting was left out (too_long.h): why. All else is then empty.
  std::string refused;
};

/// The middle of the values, and where a quarter of them lies below and above; zeros where there are none.
struct Quartiles {
  double low = 0.0, median = 0.0, high = 0.0;
};
Quartiles quartiles_of(std::vector<double> values);

/// One warm-up frame each, then `rounds` rounds, where the warm-up frame took less than 2 s; up to three
/// times as many of those whose ratios to the default method's frame still differ, between their quartiles,
/// by more than a tenth of the median. `renderer` has the case's scene. Throws Cancelled.
std::vector<Measured> measure_in_turn(Renderer& renderer, const StudyView& view,
                                      std::span<const Setting> settings, int rounds, TooLong& too_long);

/// Largest resident size, in MiB, of a program of its own that draws one frame: `penumbra render` with this
/// scene, size and setting, one sample a pixel. `threads`: 0 for all cores. Nothing where that program could
/// not be run.
std::optional<double> peak_memory(const std::string& scene_path, const StudyView& view,
                                  const Setting& setting, int threads);

}  // namespace penumbra::apps
