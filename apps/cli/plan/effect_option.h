// --effect NAME=on|off: what a plan is told to do or to leave out.
#pragma once

#include "penumbra/render/method_option.h"
#include "penumbra/render/plan/effects.h"

namespace CLI {
class App;
}

namespace penumbra::apps {

/// Sets the options effect-NAME of the method auto.
void add_effect_option(CLI::App& command, OptionValues& values);
/// Sets what a plan is asked for.
void add_effect_option(CLI::App& command, Effects& effects);

}  // namespace penumbra::apps
