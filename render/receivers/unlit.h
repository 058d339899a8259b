// Why a light lights nothing: what a warning says of a picture that stays dark.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "penumbra/render/light/light.h"
#include "penumbra/render/receivers/receivers.h"

namespace penumbra {

/// One line that names the light and says why none of the receivers sees any of it; nothing where one does,
/// or where there are no receivers. `visibility`: of the receivers under the light. Cost O(1) for a light
/// that is seen by some of the first, O(receivers) for others.
std::optional<std::string> why_nothing_is_lit(const Light& light, const Receivers& receivers,
                                              std::span<const float> visibility);

/// The same of a light of which it is known that it reaches nothing.
std::string why_dark(const Light& light);

}  // namespace penumbra
