// Progress of long calls, and stopping them.
#pragma once

#include <functional>

namespace penumbra {

/// Called now and then, never from two threads at once, with the finished fraction in [0, 1]. Return false to
/// stop: the call then throws Cancelled. An empty function means nobody asks.
using Progress = std::function<bool(double fraction)>;

}  // namespace penumbra
