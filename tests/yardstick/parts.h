// The parts of the yardstick.
#pragma once

#include "tests/yardstick/report.h"

namespace penumbra::yardstick {

/// cases.cpp: every scene of data/regressions/scenes by every method.
void judge_cases(Report& report);
/// lights.cpp: lights in, on and through a box, facing away, along faces.
void judge_lights(Report& report);
/// moves.cpp: scenes that are scaled, moved away from the origin and turned.
void judge_moves(Report& report);
/// suns.cpp: disks further and further away against the distant light of the same angle.
void judge_suns(Report& report);
/// plates.cpp: a square plate's shadow on floors of any size, in closed form.
void judge_plates(Report& report);
/// patterns.cpp: areas between the edges of blinds, gratings and moirés, and such layers as scenes.
void judge_patterns(Report& report);
/// merging.cpp: V with merged faces against V without, over 300 casters that are hard to merge.
void judge_merging(Report& report);
/// certificates.cpp: certificates of every scene of data/scenes, and of ten meshes in ten poses.
void judge_certificates(Report& report);

}  // namespace penumbra::yardstick
