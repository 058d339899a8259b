// V with merged faces against V of all faces, for the same receivers.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/render/silhouette/merge/adversarial_casters.h"

namespace penumbra::testing {

struct MergedDifference {
  double most = 0.0, square = 0.0;
  std::size_t receivers = 0, penumbra = 0, contradictions = 0, merged = 0, lost = 0;
  /// Where most is.
  std::size_t worst = 0;

  /// Over the receivers in penumbra.
  double rmse() const { return std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, penumbra))); }
  void operator+=(const MergedDifference& o) {
    most = std::max(most, o.most), square += o.square;
    receivers += o.receivers, penumbra += o.penumbra, contradictions += o.contradictions;
    merged += o.merged, lost += o.lost;
  }
};

inline MergedDifference merged_difference(const Scene& scene, const SurfaceBuffer& surface,
                                          double tolerance = SilhouetteOptions().tolerance) {
  const RayScene rays(scene, 0);
  detail::EdgeHierarchies hierarchies(scene);
  const auto see = [&](double moved) {
    SilhouetteOptions options;
    options.tolerance = moved;
    return silhouette_visibility(scene, rays, hierarchies, light_of(scene), surface.receivers(), options);
  };
  const SilhouetteResult exact = see(0.0), r = see(tolerance);
  MergedDifference out;
  out.receivers = r.counts.receivers, out.merged = r.counts.merged_receivers;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double v = exact.visibility[i], d = std::abs(r.visibility[i] - v);
    if (d > out.most) out.most = d, out.worst = i;
    if ((v > 0.0 && v < 1.0) || d > 0.0) ++out.penumbra, out.square += d * d;
    // Certified lit is what nothing hides above the horizon, and that then is all of V.
    out.contradictions += (r.region[i] == 0 && d > 1e-6) || (r.region[i] == 2 && v > 1e-5) ? 1 : 0;
    out.lost += exact.region[i] >= 0 && r.region[i] < 0 ? 1 : 0;
  }
  return out;
}

}  // namespace penumbra::testing
