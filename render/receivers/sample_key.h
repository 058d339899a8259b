// The stream of random numbers of a receiver, the same for every method that samples the light.
#pragma once

#include "penumbra/render/receivers/receivers.h"
#include "render/light/disk_samples.h"

namespace penumbra::detail {

/// A pixel by its place in the picture, any other receiver by its coordinates: its samples do not depend on
/// the order of receivers.
inline std::uint32_t sample_key_of(const Receivers& receivers, std::uint32_t receiver, std::uint64_t seed) {
  if (receivers.are_pixels()) return sample_key(seed, receiver);
  return sample_key(seed, receivers.points[receiver]);
}

}  // namespace penumbra::detail
