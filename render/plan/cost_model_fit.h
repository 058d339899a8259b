// Constants of the planner's model. Made by `./run plan-model` from data/plan/rows.json: do not edit.
#pragma once

namespace penumbra::detail::fit {

// Nanoseconds on two cores; kRaysOpen...: shares.
inline constexpr double kSilhouetteReceiver = 19.18;
inline constexpr double kSilhouetteBandEdge = 97.41;
inline constexpr double kSilhouetteMerged = 28.92;
inline constexpr double kSilhouetteRootOfEdges = 39.27;
inline constexpr double kSilhouetteLength = 38.89;
inline constexpr double kSilhouetteBox = 22.68;
inline constexpr double kRay = 4.918;
inline constexpr double kRayLogFaces = 0.452;
inline constexpr double kRayRootOfBoxes = 2.713;
inline constexpr double kRayRootOfEdges = 2.973;
inline constexpr double kRayRootOfBoth = 0.72;
inline constexpr double kRaysReceiver = 38.07;
inline constexpr double kRaysBandEdge = 189.2;
inline constexpr double kRaysRootOfEdges = 57.16;
inline constexpr double kRaysEdge = 6.579;
inline constexpr double kRaysBox = 20.2;
inline constexpr double kRaysOpenPenumbra = 0.8088;
inline constexpr double kRaysOpenRest = 0.2481;
inline constexpr double kHierarchyEdge = 464.4;
inline constexpr double kTimeOf16Rows = 0.8;
inline constexpr double kTimeOf32Rows = 0.9;
// RMSE of V over the penumbra.
inline constexpr double kErrorOfFew = 0.0004;
inline constexpr double kErrorOfMany16 = 0.004;
inline constexpr double kErrorOfMany32 = 0.002;
inline constexpr double kErrorOfMany64 = 0.001;

// Milliseconds of `penumbra plan --calibrate` on that machine.
inline constexpr double kCalibrationSilhouette = 40.0;
inline constexpr double kCalibrationReference = 250.0;

}  // namespace penumbra::detail::fit
