#include "apps/viewer/commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace penumbra::viewer {
namespace {

constexpr std::array kKeys{
    CommandKey{Command::kViewFront, GLFW_KEY_1, false, false, "1", "look from the front"},
    CommandKey{Command::kViewRight, GLFW_KEY_3, false, false, "3", "look from the right"},
    CommandKey{Command::kViewTop, GLFW_KEY_7, false, false, "7", "look from above"},
    CommandKey{Command::kFrameAll, GLFW_KEY_HOME, false, false, "Home", "show all casters"},
    CommandKey{Command::kFrameLight, GLFW_KEY_HOME, true, false, "Shift+Home", "show casters and light"},
    CommandKey{Command::kReset, GLFW_KEY_R, false, false, "R", "camera and light as loaded"},
    CommandKey{Command::kNextMethod, GLFW_KEY_M, false, false, "M", "next method"},
    CommandKey{Command::kPreviousMethod, GLFW_KEY_M, true, false, "Shift+M", "previous method"},
    CommandKey{Command::kSingle, GLFW_KEY_A, false, false, "A", "one picture"},
    CommandKey{Command::kSplit, GLFW_KEY_S, false, false, "S", "two methods, divided"},
    CommandKey{Command::kDifference, GLFW_KEY_D, false, false, "D", "difference of two methods"},
    CommandKey{Command::kLightHandles, GLFW_KEY_L, false, false, "L", "light and handles"},
    CommandKey{Command::kFaces, GLFW_KEY_F, false, false, "F", "faces by class"},
    CommandKey{Command::kSilhouettes, GLFW_KEY_E, false, false, "E", "silhouettes"},
    CommandKey{Command::kBand, GLFW_KEY_B, false, false, "B", "silhouette band"},
    CommandKey{Command::kSheets, GLFW_KEY_T, false, false, "T", "sheets: facets and cones"},
    CommandKey{Command::kPenumbraVolume, GLFW_KEY_V, false, false, "V", "penumbra volume"},
    CommandKey{Command::kUmbraVolume, GLFW_KEY_U, false, false, "U", "umbra volume"},
    CommandKey{Command::kProbe, GLFW_KEY_P, false, false, "P", "probe: the light as a receiver sees it"},
    CommandKey{Command::kPanel, GLFW_KEY_TAB, false, false, "Tab", "panel"},
    CommandKey{Command::kSavePicture, GLFW_KEY_F12, false, false, "F12", "save the picture"},
    CommandKey{Command::kSaveState, GLFW_KEY_S, false, true, "Ctrl+S", "save the state as a scene file"},
    CommandKey{Command::kCopyCommand, GLFW_KEY_C, false, true, "Ctrl+C", "save and copy the command line"},
    CommandKey{Command::kExportVolumes, GLFW_KEY_E, false, true, "Ctrl+E", "export sheets and volumes"},
    CommandKey{Command::kExportSequence, GLFW_KEY_P, false, true, "Ctrl+P",
               "pictures along the light's path"},
    CommandKey{Command::kNextFile, GLFW_KEY_PAGE_DOWN, false, false, "PgDn", "next file"},
    CommandKey{Command::kPreviousFile, GLFW_KEY_PAGE_UP, false, false, "PgUp", "previous file"},
    CommandKey{Command::kHelp, GLFW_KEY_H, false, false, "H", "this help"},
    CommandKey{Command::kLeave, GLFW_KEY_ESCAPE, false, false, "Esc", "leave"},
};

}  // namespace

std::span<const CommandKey> command_keys() {
  return kKeys;
}

const CommandKey& key_of(Command command) {
  return *std::find_if(kKeys.begin(), kKeys.end(),
                       [&](const CommandKey& each) { return each.command == command; });
}

}  // namespace penumbra::viewer
