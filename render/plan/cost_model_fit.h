// Constants of the planner's model: rough ones, by hand from single frames.
#pragma once

namespace penumbra::detail::fit {

// Nanoseconds.
inline constexpr double kSilhouetteReceiver = 60.0, kSilhouetteBandEdge = 100.0, kSilhouetteOpen = 300.0,
                        kSilhouetteEdge = 50.0, kSilhouetteMerged = 5.0;
inline constexpr double kCertifyReceiver = 60.0, kCertifyBandEdge = 100.0, kCertifyEdge = 10.0;
inline constexpr double kRay = 3.0, kRayLogFaces = 0.2, kRayBox = 0.2;
inline constexpr double kHierarchyEdge = 300.0;
// RMSE.
inline constexpr double kSilhouetteLeast = 0.0003, kSilhouetteManyEdges = 0.001;
inline constexpr double kStrata = 0.11, kStrataPower = 0.42;

}  // namespace penumbra::detail::fit
