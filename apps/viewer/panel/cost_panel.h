// The panel's part about what pictures cost.
#pragma once

#include "apps/viewer/work/costs.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

/// `frame` is what is shown; null before the first.
void cost_section(const Frame* frame, const Costs& costs);

}  // namespace penumbra::viewer
