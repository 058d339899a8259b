// The panel beside the picture: methods, light, overlays, costs, files.
#pragma once

#include <optional>
#include <string>

#include "apps/viewer/commands.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/widgets.h"
#include "apps/viewer/work/costs.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

inline constexpr int kPanelWidth = 330;  ///< pixels

struct PanelInput {
  const Frame* frame = nullptr;  ///< what is shown; null before the first
  const Costs* costs = nullptr;
  std::string message;    ///< the last thing worth saying
  bool settled = false;   ///< the picture is final
  int x = 0, height = 0;  ///< the panel's place in the window
};

class Panel {
 public:
  /// Draws the panel and changes the state as its widgets are used. A button's command is returned.
  std::optional<Command> draw(State& state, const PanelInput& input);
  /// Centers of the widgets drawn last, by label, in window pixels: for scripts.
  const Places& places() const { return places_; }

 private:
  Places places_;
};

}  // namespace penumbra::viewer
