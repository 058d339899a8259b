// The picture's part of the window: textures of the latest frame, divider, labels, the light.
#pragma once

#include <memory>

#include "apps/viewer/handles/pointer.h"
#include "apps/viewer/pictures/picture_texture.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

struct ImDrawList;

namespace penumbra::viewer {

class PictureView {
 public:
  /// `plain`: titles and legend are left out.
  PictureView(const gl::Functions& gl, bool plain)
      : plain_(plain), left_(gl), right_(gl), difference_(gl), textures_(gl) {}
  /// The frame to draw from now on; its pictures come with the next upload.
  void show(std::shared_ptr<const Frame> frame) { frame_ = std::move(frame); }
  /// Uploads what has changed since the last call: before what ImGui was told is drawn.
  void upload(const State& state);
  /// The pictures, into ImGui's background.
  void draw_picture(const State& state) const;
  /// What lies over them: divider, method and frame rate, the light, legend.
  struct Marks {
    const Pointer& pointer;
    bool settled;
    int per_second;  ///< pictures that arrived in the last second
  };
  void draw_marks(const State& state, const Marks& marks) const;
  const Frame* frame() const { return frame_.get(); }

 private:
  void draw_textures(ImDrawList& list, float width, float height) const;
  void draw_titles(ImDrawList& list, const State& state, const Marks& marks) const;

  bool plain_;
  PictureTexture left_, right_, difference_, textures_;
  std::shared_ptr<const Frame> frame_, uploaded_;
  double exposure_ = 0.0, scale_ = 0.0;
  Shown shown_ = Shown::kPicture;
};

}  // namespace penumbra::viewer
