// Scenes for the planner: named ones, on which its model is fitted, some that are hard on one method, and
// scenes by chance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace penumbra::bench {

/// Those of the fit.
std::vector<std::string> fit_cases();
/// Those on which some method is foolish.
std::vector<std::string> foolish_cases();

/// A scene with one light, by its name:
///
///   NAME                 of data/scenes
///   wide-FACTOR-NAME     the same, its light's radius times FACTOR
///   soup-COUNT-SIZE-R    triangles strewn over a floor under a light of radius R
///   fan-PLEATS-R         a pleated fan: every edge is a silhouette for some receiver
///   ball-LEVEL-R         a sphere of 20·4^LEVEL faces
///   wires-COUNT-R        long thin triangles across all of the floor
///   grass-COUNT-R        blades on the floor
///   balls-COUNT-R        small spheres in a box, of 80 faces each
///   random-SEED          by chance: a floor, a terrain or a room; up to eight casters of all kinds; a disk
///                        or a sun
///
/// Throws UsageError for other names.
Scene plan_case(const std::string& name);

}  // namespace penumbra::bench
