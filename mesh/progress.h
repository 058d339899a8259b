// How far a long call is, and how to stop it.
#pragma once

#include <functional>

#include "penumbra/mesh/error.h"

namespace penumbra {

/// A long call calls this now and then with the finished fraction of its work, in [0, 1] and never falling.
/// It never does so from two threads at once. Return false to stop: the long call then throws Cancelled. An
/// empty function is never called.
using Progress = std::function<bool(double fraction)>;

/// Calls `progress`, if there is one. Throws Cancelled where it returns false.
inline void report(const Progress& progress, double fraction) {
  if (progress && !progress(fraction)) throw Cancelled();
}

/// The progress of one part of a longer call: the part's fractions 0 to 1 become `begin` to `end` of the
/// whole.
inline Progress part_of(const Progress& whole, double begin, double end) {
  if (!whole) return {};
  return [whole, begin, end](double fraction) { return whole(begin + fraction * (end - begin)); };
}

}  // namespace penumbra
