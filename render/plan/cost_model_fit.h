// Constants of the planner's model. Made by `./run plan-model` from data/plan/rows.json: do not edit.
#pragma once

namespace penumbra::detail::fit {

// Nanoseconds on two cores; kRaysOpen...: shares.
inline constexpr double kSilhouetteReceiver = 20.96;
inline constexpr double kSilhouetteBandEdge = 79.54;
inline constexpr double kSilhouetteMerged = 47.48;
inline constexpr double kSilhouetteRootOfEdges = 63.81;
inline constexpr double kSilhouetteBox = 28.17;
inline constexpr double kRay = 4.417;
inline constexpr double kRayLogFaces = 0.4403;
inline constexpr double kRayRootOfBoxes = 5.522;
inline constexpr double kRayRootOfEdges = 4.764;
inline constexpr double kRaysReceiver = 38.07;
inline constexpr double kRaysBandEdge = 189.2;
inline constexpr double kRaysRootOfEdges = 57.16;
inline constexpr double kRaysEdge = 6.579;
inline constexpr double kRaysBox = 20.2;
inline constexpr double kRaysOpenPenumbra = 0.8088;
inline constexpr double kRaysOpenRest = 0.2481;
inline constexpr double kHierarchyEdge = 464.4;

}  // namespace penumbra::detail::fit
