// Progress of long calls, and stopping them.
#pragma once

#include <functional>

#include "penumbra/mesh/error.h"

namespace penumbra {

/// Called now and then, never from two threads at once, with the finished fraction in [0, 1]. Return false to
/// stop: the call then throws Cancelled. An empty function means nobody asks.
using Progress = std::function<bool(double fraction)>;

/// Tells how far a call is. Throws Cancelled where it is to stop.
inline void report(const Progress& progress, double fraction) {
  if (progress && !progress(fraction)) throw Cancelled();
}

}  // namespace penumbra
