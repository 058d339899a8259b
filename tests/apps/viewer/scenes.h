// States of the scenes of data/, for tests without a window.
#pragma once

#include <filesystem>
#include <string>

#include "apps/viewer/state/document.h"

namespace penumbra::viewer {

inline std::filesystem::path data_path(const std::string& name) {
  return std::filesystem::path(PENUMBRA_DATA) / name;
}

inline State sized_state(int width = 640, int height = 480) {
  State state;
  state.left.width = state.right.width = width;
  state.left.height = state.right.height = height;
  return state;
}

inline Document document_of(const std::string& name) {
  return {data_path(name), sized_state(), false};
}

}  // namespace penumbra::viewer
