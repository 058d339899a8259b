// What a plan may be told to do or to leave out, one by one, whatever is measured.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace penumbra {

enum class EffectChoice {
  /// As the plan decides.
  kPlanned,
  kOn,
  kOff,
};

struct Effects {
  /// Off: nothing casts a shadow, no ray is traced. On: shadows are looked for where it is proved that there
  /// are none, too.
  EffectChoice shadows = EffectChoice::kPlanned;
  /// Off: hard shadows, one ray a receiver. On: penumbras however narrow; a point light has none.
  EffectChoice penumbra = EffectChoice::kPlanned;
  /// Casters that reach no receiver are left out. On: however few faces they have.
  EffectChoice culling = EffectChoice::kPlanned;
  /// Receivers that no edge can divide the light for are certified. Off: by no method; rays are traced
  /// everywhere.
  EffectChoice certificates = EffectChoice::kPlanned;
  /// Areas between edges are integrated. On: at all receivers. Off: at none.
  EffectChoice areas = EffectChoice::kPlanned;
  /// Fine faces are merged for areas, which takes a hierarchy of its own. On: in all areas. Off: in none.
  EffectChoice merging = EffectChoice::kPlanned;
};

struct EffectName {
  const char* name;
  EffectChoice Effects::*member;
  const char* help;
};

/// All of them. The method auto has an option effect-NAME for each: planned, on or off.
inline constexpr std::array<EffectName, 6> kEffects{
    {{"shadows", &Effects::shadows, "Shadows; off: no ray is traced"},
     {"penumbra", &Effects::penumbra, "Penumbras; off: hard shadows"},
     {"culling", &Effects::culling, "Casters that reach no receiver are left out"},
     {"certificates", &Effects::certificates, "Receivers without an edge before the light are certified"},
     {"areas", &Effects::areas, "Areas between edges; on: at all receivers, off: at none"},
     {"merging", &Effects::merging, "Fine faces are merged for areas"}}};

}  // namespace penumbra
