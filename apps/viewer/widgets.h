// Widgets that several parts of the panel use.
#pragma once

#include <imgui.h>

#include <map>
#include <string>
#include <vector>

#include "apps/viewer/handles/projection.h"

namespace penumbra::viewer {

/// Centers of widgets in window pixels, by label.
using Places = std::map<std::string, PicturePoint>;

/// Of the widget drawn last.
void note_place(Places& places, const std::string& name);
/// A tooltip for the widget drawn last.
void help_on_hover(const std::string& text);
/// True where the value was changed.
bool slider(Places& places, const char* label, double& value, double low, double high, const char* format,
            ImGuiSliderFlags flags = 0);
/// True where another word was chosen.
bool combo(const char* label, std::string& value, const std::vector<std::string>& words);

}  // namespace penumbra::viewer
