// The probe: what a point of the picture sees of the light, and what every method on show says of it.
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "apps/viewer/handles/pointer.h"
#include "apps/viewer/pictures/picture_texture.h"
#include "apps/viewer/state/state.h"
#include "penumbra/render/visibility.h"

namespace penumbra::viewer {

/// The answer to one question, made in the background.
struct ProbeAnswer {
  Pixels disk;
  double by_rays = 0.0, above_horizon = 0.0;
};

class ProbeView {
 public:
  ProbeView(const gl::Functions& gl, void (*wake)()) : texture_(gl), wake_(wake) {}
  ~ProbeView();
  /// Draws the probe's window for the place under the pointer; over the panel the last place stays.
  void draw(const State& state, const Frame* frame, const Pointer& pointer);
  bool busy() const { return task_.valid(); }

 private:
  struct Place {
    std::size_t pixel;  ///< of the frame's images
    std::int32_t object;
    std::uint32_t face;
    Vec3 position, normal;
  };
  void ask(const State& state, const Frame& frame);
  void write(const State& state, const Frame& frame) const;

  PictureTexture texture_;
  void (*wake_)();
  std::optional<PicturePoint> at_;
  std::optional<Place> place_;
  std::shared_ptr<const Casters> casters_;  ///< of the model casters_for_
  std::shared_ptr<const Scene> casters_for_;
  std::uint64_t asked_frame_ = 0;
  std::optional<std::size_t> asked_pixel_;
  std::future<std::pair<std::shared_ptr<const Casters>, ProbeAnswer>> task_;
  std::optional<ProbeAnswer> answer_;
};

}  // namespace penumbra::viewer
