// Solids: what would replace an edge of a surface.
#pragma once

#include <optional>
#include <vector>

#include "volumes/solids/simplify/changing_surface.h"

namespace penumbra::detail {

struct CollapsePlan {
  Vec3 point;
  double cost;   ///< how much volume changes
  double error;  ///< how far the surface may have moved since the start
};

/// One a thread. Refers to the surface.
class CollapsePlanner {
 public:
  explicit CollapsePlanner(const ChangingSurface& surface) : surface_(surface) {}

  /// Nothing where no point on the safe side is near enough. Does not look at what lies beside the edge's
  /// triangles.
  std::optional<CollapsePlan> plan_for(std::uint32_t a, std::uint32_t b);

 private:
  bool find_limits(std::uint32_t a, std::uint32_t b);

  const ChangingSurface& surface_;
  std::vector<PlaneLimit> limits_;
  std::vector<double> areas_;
};

}  // namespace penumbra::detail
