// Constants of the planner's model. Made by `./run plan-model` from data/plan/rows.jsonl: do not edit.
#pragma once

namespace penumbra::detail::fit {

// Nanoseconds on two cores; kRaysOpen...: factors.
inline constexpr double kSilhouetteReceiver = 17.82;
inline constexpr double kSilhouetteCasterEdge = 12.94;
inline constexpr double kSilhouetteBandEdge = 442.2;
inline constexpr double kSilhouetteMerged = 28.73;
inline constexpr double kSilhouetteRootOfEdges = 0;
inline constexpr double kSilhouetteLength = 43.67;
inline constexpr double kSilhouetteBox = 22.31;
inline constexpr double kRayReceiver = 75.95;
inline constexpr double kRayReceiverRootOfBoth = 0;
inline constexpr double kRay = 2.591;
inline constexpr double kRayLogFaces = 0.3694;
inline constexpr double kRayRootOfBoxes = 2.393;
inline constexpr double kRayRootOfEdges = 1.712;
inline constexpr double kRayRootOfBoth = 0.6531;
inline constexpr double kRaysReceiver = 16.99;
inline constexpr double kRaysCasterEdge = 24.43;
inline constexpr double kRaysBandEdge = 293.8;
inline constexpr double kRaysRootOfEdges = 35.89;
inline constexpr double kRaysEdge = 0;
inline constexpr double kRaysBox = 20.93;
inline constexpr double kRaysOpenPenumbra = 1.414;
inline constexpr double kRaysOpenRest = 0.537;
inline constexpr double kHierarchyEdge = 145.8;
inline constexpr double kMergingEdge = 0;
inline constexpr double kMergingEdgeTimesRoot = 0.9158;
inline constexpr double kErrorOfFew = 0.000428;
inline constexpr double kErrorOfMany = 0.000836;

}  // namespace penumbra::detail::fit
