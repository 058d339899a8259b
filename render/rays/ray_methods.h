// Methods that are rays and nothing else.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Stratified rays to every receiver (reference.h).
MethodInfo reference_method();
/// One ray to the light's center (hard.h).
MethodInfo hard_method();
/// No shadows: what the horizon leaves of the light.
MethodInfo no_shadow_method();

/// The options samples and seed, for every method that traces stratified rays.
std::vector<OptionSchema> sampling_options();
/// The same for methods that cost far more with many samples: a study tries 64, 256 and 1,024.
std::vector<OptionSchema> dear_sampling_options();
struct ReferenceOptions;
ReferenceOptions sampling_of(const OptionValues& options);

}  // namespace penumbra
