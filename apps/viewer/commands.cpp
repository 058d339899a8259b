#include "apps/viewer/commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace penumbra::viewer {
namespace {

using C = Command;
using M = Menu;

constexpr std::array kKeys{
    CommandKey{C::kOpen, M::kFile, GLFW_KEY_O, false, true, "Ctrl+O", "Open a mesh or a scene..."},
    CommandKey{C::kNextFile, M::kFile, GLFW_KEY_PAGE_DOWN, false, false, "PgDn", "Next file"},
    CommandKey{C::kPreviousFile, M::kFile, GLFW_KEY_PAGE_UP, false, false, "PgUp", "Previous file"},
    CommandKey{C::kSavePicture, M::kFile, GLFW_KEY_F12, false, false, "F12", "Save the picture"},
    CommandKey{C::kSaveState, M::kFile, GLFW_KEY_S, false, true, "Ctrl+S", "Save as a scene file"},
    CommandKey{C::kCopyCommand, M::kFile, GLFW_KEY_C, false, true, "Ctrl+C", "Save, copy its command line"},
    CommandKey{C::kExportSolids, M::kFile, GLFW_KEY_E, false, true, "Ctrl+E",
               "Export umbra and penumbra as solids"},
    CommandKey{C::kExportCells, M::kFile, GLFW_KEY_E, true, true, "Ctrl+Shift+E", "Export sheets and cells"},
    CommandKey{C::kExportSequence, M::kFile, GLFW_KEY_P, false, true, "Ctrl+P",
               "Export 24 pictures of the light's way"},
    CommandKey{C::kLeave, M::kFile, GLFW_KEY_ESCAPE, false, false, "Esc", "Leave"},
    CommandKey{C::kUndo, M::kEdit, GLFW_KEY_Z, false, true, "Ctrl+Z", "Undo"},
    CommandKey{C::kRedo, M::kEdit, GLFW_KEY_Z, true, true, "Ctrl+Shift+Z", "Redo"},
    CommandKey{C::kRedo, M::kEdit, GLFW_KEY_Y, false, true, "Ctrl+Y", "Redo"},
    CommandKey{C::kReset, M::kEdit, GLFW_KEY_R, false, false, "R", "Camera and light as loaded"},
    CommandKey{C::kViewFront, M::kView, GLFW_KEY_1, false, false, "1", "Look from the front"},
    CommandKey{C::kViewRight, M::kView, GLFW_KEY_3, false, false, "3", "Look from the right"},
    CommandKey{C::kViewTop, M::kView, GLFW_KEY_7, false, false, "7", "Look from above"},
    CommandKey{C::kFrameAll, M::kView, GLFW_KEY_HOME, false, false, "Home", "Show all casters"},
    CommandKey{C::kFrameLight, M::kView, GLFW_KEY_HOME, true, false, "Shift+Home", "Show casters and light"},
    CommandKey{C::kPanel, M::kView, GLFW_KEY_TAB, false, false, "Tab", "Panel"},
    CommandKey{C::kSingle, M::kPicture, GLFW_KEY_A, false, false, "A", "One picture"},
    CommandKey{C::kSplit, M::kPicture, GLFW_KEY_S, false, false, "S", "Two methods, divided"},
    CommandKey{C::kDifference, M::kPicture, GLFW_KEY_D, false, false, "D", "Difference of two methods"},
    CommandKey{C::kNextMethod, M::kPicture, GLFW_KEY_M, false, false, "M", "Next method"},
    CommandKey{C::kPreviousMethod, M::kPicture, GLFW_KEY_M, true, false, "Shift+M", "Previous method"},
    CommandKey{C::kLightHandles, M::kOverlay, GLFW_KEY_L, false, false, "L", "Light and its handles"},
    CommandKey{C::kUmbraSolid, M::kOverlay, GLFW_KEY_U, false, false, "U",
               "Umbra: where all of the light is hidden"},
    CommandKey{C::kPenumbraSolid, M::kOverlay, GLFW_KEY_V, false, false, "V",
               "Penumbra: where some of the light is hidden"},
    CommandKey{C::kSilhouettes, M::kOverlay, GLFW_KEY_E, false, false, "E",
               "Silhouettes that bound umbra and penumbra"},
    CommandKey{C::kBand, M::kOverlay, GLFW_KEY_B, false, false, "B",
               "Band: every edge that may be a silhouette"},
    CommandKey{C::kFaces, M::kOverlay, GLFW_KEY_F, false, false, "F", "Faces by how much light they face"},
    CommandKey{C::kSheets, M::kOverlay, GLFW_KEY_T, false, false, "T",
               "Sheets: facets and cones that bound the shadow"},
    CommandKey{C::kUmbraCells, M::kOverlay, GLFW_KEY_U, true, false, "Shift+U",
               "Umbra as the sum of convex cells"},
    CommandKey{C::kPenumbraCells, M::kOverlay, GLFW_KEY_V, true, false, "Shift+V",
               "Penumbra as the sum of convex cells"},
    CommandKey{C::kProbe, M::kOverlay, GLFW_KEY_P, false, false, "P", "Probe: the light as a point sees it"},
    CommandKey{C::kHelp, M::kHelp, GLFW_KEY_H, false, false, "H", "Mouse and keys"},
    CommandKey{C::kHelp, M::kHelp, GLFW_KEY_F1, false, false, "F1", "Mouse and keys"},
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
