// What receivers see of the sun as it moves: the fraction at any time, and the times at which it begins and
// ends.
//
//   casters, receivers   as in render/visibility.h
//   sky                  where the scene lies on earth
//   time                 seconds since 1970 UTC
//
// The sun shines as far as it stands above the horizontal plane: below it everything is dark. While the plane
// cuts the disk, a receiver sees the smaller of what its own horizon and casters leave and of what the plane
// and casters leave. That is exact unless both planes cut the disk at the same time.
//
// The fraction is a continuous function of time without noise, so that its roots can be found by bisection. A
// contact is a root of V = 10⁻⁵ or of V = 1 - 10⁻⁵: where a straight edge moves across the disk by h of its
// radius, V is .6 h^1.5, and 10⁻⁵ is passed .04 s after the true contact.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "penumbra/render/sun/sun_position.h"
#include "penumbra/render/visibility.h"

namespace penumbra {

struct SunSky {
  SunSite site;
  SceneAxes axes;
};

/// The four contacts of an eclipse, the other way round for the morning.
enum class SunContactKind : std::uint8_t {
  kFirstLight,  ///< the sun begins to appear
  kFullLight,   ///< all of it is seen
  kFirstShade,  ///< it begins to be hidden
  kLastLight,   ///< the last of it is hidden
};
/// "first light", "full light", "first shade" or "last light".
const char* name_of(SunContactKind kind);

struct SunContact {
  std::uint32_t receiver = 0;
  double time = 0.0;
  SunContactKind kind{};
};

struct SunCounts {
  /// Times that were looked at, and of these those at which the sun was below the horizontal plane.
  std::size_t times = 0, nights = 0;
  /// Visibilities that were found.
  std::size_t receivers = 0;
};

/// Refers to casters, and to the receivers' arrays. For one thread at a time.
class SunExposure {
 public:
  /// Throws UsageError as visibility and sun_light do.
  SunExposure(const Casters& casters, const Receivers& receivers, const SunSky& sky,
              VisibilityOptions options = {});

  /// The fraction that each receiver sees at that time. Receivers are grouped and hierarchies made by the
  /// first call.
  std::vector<float> seen(double time);
  /// The contacts between two times, in order of receivers and times, off by `precision` seconds at most;
  /// `before` and `after`: what is seen then. Found is what is different before and after: a glimpse of the
  /// sun between two times of shade is not, so that the times should be close. Silhouettes are not moved
  /// (option silhouette-tolerance) unless the options say so. Cost: as many visibilities a contact as
  /// halvings of the time between.
  std::vector<SunContact> contacts(double from, std::span<const float> before, double to,
                                   std::span<const float> after, double precision = 0.25);

  const SunCounts& counts() const { return counts_; }

 private:
  std::vector<float> seen_by(const Receivers& receivers, double time, const VisibilityOptions& options);

  const Casters& casters_;
  Receivers receivers_;
  SunSky sky_;
  VisibilityOptions options_, exact_;
  SunCounts counts_;
};

}  // namespace penumbra
