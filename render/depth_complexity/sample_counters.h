// Method depth-complexity, step counters: by how many faces more or fewer than a start on the light each
// sample is hidden.
//
// The number of faces between a receiver and a point of the light jumps at the receiver's silhouettes. So it
// differs between a start p and a sample s by the jumps of the silhouettes that the segment p s crosses. A
// light is convex: the segment stays on it, and above the receiver's horizon where both ends are.
//
// The segment crosses an edge a → b where the line p s passes between a and b, and s lies beyond the line a
// b. On which side of the line p s an end lies is computed from p, s and that end alone. Two edges that share
// it get the same bits, so that no segment slips between them. Only a sample that lies on an edge within
// rounding may be counted on either side of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/light/area_light.h"
#include "render/light/light_samples.h"
#include "render/silhouette/edges/projected_segment.h"
#include "render/silhouette/edges/unit_light.h"

namespace penumbra::detail {

/// One receiver of the light.
struct SampledReceiver {
  /// To the light's center (AreaLight::from_receiver), in the world.
  Vec3 to_center;
  /// Unit, in the world; 0: nothing lies below a horizon.
  Vec3 normal;
  /// The stream of its samples.
  std::uint32_t key;
  /// The start, on the unit disk.
  glm::dvec2 start;
};

/// The samples of one receiver after the other, with memory kept between them.
class SampleCounters {
 public:
  /// `unit`: the frame of a disk that holds the light. Refers to both.
  SampleCounters(const AreaLight& light, const UnitLight& unit, int samples);

  /// Samples a receiver.
  int count() const { return table_.strata.count(); }
  /// Places the samples, and sets all counters to 0.
  void begin(const SampledReceiver& receiver);
  /// Changes the counters of the samples behind a silhouette, as seen from the start. Returns how many. Cost
  /// O(samples).
  std::size_t toggle(const Segment& segment);

  /// The samples above the horizon whose counter is lowest.
  struct Lowest {
    /// 0 where no sample is above the horizon.
    std::size_t samples = 0;
    /// One of them; of some the one that is farthest from all segments.
    std::size_t aim = 0;
  };
  /// Cost O(samples), and O(segments).
  Lowest lowest(std::span<const Segment> segments) const;
  /// From the receiver to a sample, in the world.
  Vec3 way(std::size_t sample) const;

 private:
  const AreaLight& light_;
  StratumTable table_;
  /// Half axes of the light in the world, and on the unit disk.
  Vec3 u_, v_;
  glm::dvec2 unit_u_, unit_v_;
  SampledReceiver receiver_{};
  /// One entry a sample, padded to whole lanes: the place on the light, relative to the start on the unit
  /// disk, the counter, and the height over the tangent plane. What pads is never above it.
  std::vector<float> a_, b_;
  std::vector<double> x_, y_, counter_, height_;
};

}  // namespace penumbra::detail
