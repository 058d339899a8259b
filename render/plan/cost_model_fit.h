// Constants of the planner's model. Made by `./run plan-model` from data/plan/rows.jsonl: do not edit.
#pragma once

namespace penumbra::detail::fit {

// Nanoseconds on two cores; kRaysOpen...: factors.
inline constexpr double kSilhouetteReceiver = 17.88;
inline constexpr double kSilhouetteCasterEdge = 12.46;
inline constexpr double kSilhouetteBandEdge = 447.8;
inline constexpr double kSilhouetteMerged = 28.5;
inline constexpr double kSilhouetteRootOfEdges = 0;
inline constexpr double kSilhouetteLength = 45.5;
inline constexpr double kSilhouetteBox = 22.25;
inline constexpr double kRayReceiver = 75.82;
inline constexpr double kRay = 2.581;
inline constexpr double kRayLogFaces = 0.3697;
inline constexpr double kRayRootOfBoxes = 2.421;
inline constexpr double kRayRootOfEdges = 1.696;
inline constexpr double kRayRootOfBoth = 0.6281;
inline constexpr double kRaysReceiver = 18.31;
inline constexpr double kRaysCasterEdge = 25.74;
inline constexpr double kRaysBandEdge = 299.8;
inline constexpr double kRaysRootOfEdges = 34.85;
inline constexpr double kRaysEdge = 0;
inline constexpr double kRaysBox = 20.39;
inline constexpr double kRaysOpenPenumbra = 1.41;
inline constexpr double kRaysOpenRest = 0.5712;
inline constexpr double kHierarchyEdge = 146.8;
inline constexpr double kMergingEdge = 0;
inline constexpr double kMergingEdgeTimesRoot = 0.9246;
// RMSE of V over the penumbra; kErrorOfRays: a factor.
inline constexpr double kErrorOfFew = 0.000428;
inline constexpr double kErrorOfMany = 0.000836;
inline constexpr double kErrorOfRays = 1.2;
// Milliseconds of `penumbra plan --calibrate` on that machine.
inline constexpr double kCalibrationSilhouette = 40;
inline constexpr double kCalibrationReference = 250;

}  // namespace penumbra::detail::fit
