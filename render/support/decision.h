// What was decided for a frame without being asked for, and why. Ready to be shown.
#pragma once

#include <string>
#include <vector>

namespace penumbra {

/// A number that a decision rests on.
struct DecisionNumber {
  std::string name{};
  double value = 0.0;
};

struct Decision {
  /// What it is about: "light", "caster 3 (bunny.ply)", "method".
  std::string about{};
  /// What is done: "left out", "silhouette".
  std::string choice{};
  /// A word that stays the same from version to version: "misses-receivers".
  std::string reason{};
  /// The reason as one sentence.
  std::string text{};
  /// It is proved that the picture is the same without; else it is a bound or an estimate.
  bool is_certificate = false;
  std::vector<DecisionNumber> numbers{};
};

}  // namespace penumbra
