// What the viewer can be told by a key, in one table: keys, menus and help are made from it.
#pragma once

#include <span>

namespace penumbra::viewer {

enum class Command {
  kOpen,
  kNextFile,
  kPreviousFile,
  kSavePicture,
  kSaveState,
  kCopyCommand,
  kExportSolids,
  kExportCells,
  kExportSequence,
  kLeave,
  kUndo,
  kRedo,
  kReset,
  kViewFront,
  kViewRight,
  kViewTop,
  kFrameAll,
  kFrameLight,
  kPanel,
  kSingle,
  kSplit,
  kDifference,
  kNextMethod,
  kPreviousMethod,
  kLightHandles,
  kUmbraSolid,
  kPenumbraSolid,
  kSilhouettes,
  kBand,
  kFaces,
  kSheets,
  kUmbraCells,
  kPenumbraCells,
  kProbe,
  kHelp,
};

/// The menu that has the command. Overlays have check boxes instead.
enum class Menu { kFile, kEdit, kView, kPicture, kOverlay, kHelp };

struct CommandKey {
  Command command;
  Menu menu;
  int key;  ///< GLFW's number
  bool shift, control;
  const char* shown;  ///< the key's name
  const char* label;  ///< what it does
};
/// A command may have several keys: the first one is the one to show.
std::span<const CommandKey> command_keys();
const CommandKey& key_of(Command command);

}  // namespace penumbra::viewer
