// Widgets that several parts of the window use.
#pragma once

#include <imgui.h>

#include <map>
#include <string>
#include <vector>

#include "apps/viewer/handles/projection.h"

namespace penumbra::viewer {

/// Centers of widgets in window pixels, by what is written on them.
using Places = std::map<std::string, PicturePoint>;

/// Of the widget drawn last.
void note_place(Places& places, const std::string& name);
/// A tooltip for the widget drawn last.
void help_on_hover(const std::string& text);

/// Writes the label at the left; the next widget fills the rest of the line.
void label_of_next(const char* label);
/// With its label. True where the value was changed.
bool slider(Places& places, const char* label, double& value, double low, double high, const char* format,
            ImGuiSliderFlags flags = 0);
/// A choice of texts, with its label; returns the chosen number, or `chosen`. `help`: none, or one a text.
std::size_t combo(Places& places, const char* label, std::size_t chosen,
                  const std::vector<std::string>& texts, const std::vector<std::string>& help = {});
/// Radio buttons in a line. True where another one was chosen.
bool radio_line(Places& places, int& chosen, const std::vector<const char*>& texts,
                const std::vector<const char*>& help = {});
bool button(Places& places, const char* label);

/// Roomier paddings and a border, for dialogs, while it lives.
class DialogStyle {
 public:
  DialogStyle();
  ~DialogStyle();
  DialogStyle(const DialogStyle&) = delete;
  DialogStyle& operator=(const DialogStyle&) = delete;
};

}  // namespace penumbra::viewer
