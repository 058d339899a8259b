// The command line of penumbra-viewer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

struct ViewerOptions {
  std::vector<std::filesystem::path> files;  ///< none: the window asks for one
  int width = 960, height = 680;             ///< of the picture; the panel is beside it
  State state;                               ///< methods and settings to start with
  std::optional<std::string> method;         ///< where given, instead of what a saved state says
  std::optional<Arrangement> view;
  bool plain = false;      ///< nothing but the picture
  double font_size = 0.0;  ///< pixels; 0: as the display asks for
  std::filesystem::path screenshot;
  int frames = 1;                             ///< window frames before the screenshot
  std::filesystem::path status;               ///< written whenever what it says changes
  std::optional<std::uint64_t> random_input;  ///< seed of a hand that does anything
  double seconds = 60.0;                      ///< of random input
  std::vector<std::string> drop;              ///< dropped on the window once its first picture is final
  std::filesystem::path output = ".";         ///< folder for pictures and states that are saved
};

/// Runs the whole program: exit code as apps/common/failures.h has them.
int run_viewer(int argc, char** argv);

}  // namespace penumbra::viewer
