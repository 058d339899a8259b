// All that is drawn where the picture is: the picture, overlays, solids, marks, legend, probe.
#pragma once

#include <memory>
#include <string>

#include "apps/viewer/handles/pointer.h"
#include "apps/viewer/pictures/overlay_pass.h"
#include "apps/viewer/pictures/picture_view.h"
#include "apps/viewer/pictures/probe_view.h"
#include "apps/viewer/pictures/solid_pass.h"

namespace penumbra::viewer {

struct CanvasInput {
  const Pointer& pointer;
  bool settled;    ///< the picture is final
  bool moving;     ///< something is being dragged
  int per_second;  ///< pictures that arrived in the last second
};

class Canvas {
 public:
  /// `plain`: titles and legend are left out. `wake` is called from other threads when there is something new
  /// to draw.
  Canvas(const gl::Functions& gl, bool plain, void (*wake)());
  /// The frame to draw from now on.
  void show(std::shared_ptr<const Frame> frame) { view_.show(std::move(frame)); }
  /// Uploads the pictures where the frame is another one. Between draw and what draws ImGui's lists.
  void upload(const State& state) { view_.upload(state); }
  const Frame* frame() const { return view_.frame(); }
  /// Into ImGui's background, and the probe's window.
  void draw(const State& state, const CanvasInput& input);
  /// Something is still being made.
  bool busy() const { return overlay_maker_.busy() || solid_maker_.busy() || probe_.busy(); }
  /// What is being made that takes long, in words; empty where nothing is.
  std::string activity() const { return solid_maker_.activity(); }
  /// Of the solids that are shown, the detail; 0 where none are.
  double solid_detail() const { return solids_ ? solids_->detail : 0.0; }
  std::string trouble() const { return solids_ ? solids_->trouble : std::string(); }

 private:
  void draw_geometry();

  PictureView view_;
  OverlayMaker overlay_maker_;
  OverlayPass overlay_pass_;
  SolidMaker solid_maker_;
  SolidPass solid_pass_;
  ProbeView probe_;
  std::shared_ptr<const Solids> solids_;
  const State* drawn_ = nullptr;  ///< the state of this frame
};

}  // namespace penumbra::viewer
