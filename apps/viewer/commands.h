// What the viewer can be told by a key, in one table: keys, help and panel buttons are made from it.
#pragma once

#include <span>

namespace penumbra::viewer {

enum class Command {
  kViewFront,
  kViewRight,
  kViewTop,
  kFrameAll,
  kFrameLight,
  kReset,
  kNextMethod,
  kPreviousMethod,
  kSingle,
  kSplit,
  kDifference,
  kLightHandles,
  kFaces,
  kSilhouettes,
  kBand,
  kSheets,
  kPenumbraVolume,
  kUmbraVolume,
  kProbe,
  kPanel,
  kSavePicture,
  kSaveState,
  kCopyCommand,
  kExportVolumes,
  kExportSequence,
  kNextFile,
  kPreviousFile,
  kHelp,
  kLeave,
};

struct CommandKey {
  Command command;
  int key;  ///< GLFW's number
  bool shift, control;
  const char* shown;  ///< the key's name
  const char* help;
};
std::span<const CommandKey> command_keys();
const CommandKey& key_of(Command command);

}  // namespace penumbra::viewer
