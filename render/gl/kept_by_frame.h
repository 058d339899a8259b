// What a method with OpenGL keeps from call to call: its context, and one thing for each frame of rays.
#pragma once

#include <algorithm>
#include <list>
#include <memory>

#include "penumbra/render/method.h"
#include "render/gl/context.h"
#include "render/rays/ray_scene.h"

namespace penumbra::gl {

/// T is made by T(Context&, const Scene&, const RayScene&). As many are kept as MethodInput::kept_frames says, those
/// that were used last. Another backend makes the context and everything in it anew.
template <class T>
class KeptByFrame {
 public:
  /// Refers to the scene.
  explicit KeptByFrame(const Scene& scene) : scene_(scene) {}

  /// What works with the input's rays. Throws SystemError where OpenGL does not start.
  T& for_input(const MethodInput& input) {
    const Backend backend = backend_of(word_of(input.options, "backend"));
    if (!context_ || backend_ != backend) {
      kept_.clear();  // before their context
      context_ = make_context(backend);
      backend_ = backend;
    }
    const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
      return kept.rays == &input.rays && kept.frame == input.rays.frame();
    });
    if (known != kept_.end()) {
      kept_.splice(kept_.begin(), kept_, known);
    } else {
      kept_.emplace_front(*context_, scene_, input.rays);
      if (kept_.size() > input.kept_frames) kept_.pop_back();
    }
    return kept_.front().value;
  }
  /// Of the context that for_input has made.
  std::string renderer() const { return context_->renderer(); }
  template <class Visit>
  void for_each(const Visit& visit) {
    for (Kept& kept : kept_) visit(kept.value);
  }

 private:
  struct Kept {
    Kept(Context& context, const Scene& scene, const RayScene& rays_)
        : rays(&rays_), frame(rays_.frame()), value(context, scene, rays_) {}

    const RayScene* rays;
    RayFrame frame;
    T value;
  };

  const Scene& scene_;
  std::unique_ptr<Context> context_;
  Backend backend_{};
  std::list<Kept> kept_;  ///< the last used first
};

}  // namespace penumbra::gl
