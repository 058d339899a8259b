// What a method with OpenGL keeps from call to call: its context, and one thing in it.
#pragma once

#include <memory>
#include <optional>

#include "penumbra/render/method.h"
#include "render/gl/context.h"

namespace penumbra::gl {

/// T is made by T(Context&, const Scene&, const RayScene&). Another backend makes the context and T anew,
/// other rays make T anew.
template <class T>
class KeptInContext {
 public:
  /// Refers to the scene.
  explicit KeptInContext(const Scene& scene) : scene_(scene) {}

  /// What works with the input's rays. Throws SystemError where OpenGL does not start.
  T& for_input(const MethodInput& input) {
    const Backend backend = backend_of(word_of(input.options, "backend"));
    if (!context_ || backend_ != backend) {
      kept_.reset();  // before its context
      context_ = make_context(backend);
      backend_ = backend;
    }
    if (!kept_ || rays_ != &input.rays) {
      kept_.reset();  // before another one takes memory
      kept_.emplace(*context_, scene_, input.rays);
      rays_ = &input.rays;
    }
    return *kept_;
  }
  /// None before the first input.
  T* get() { return kept_ ? &*kept_ : nullptr; }
  /// Of the context that for_input has made.
  std::string renderer() const { return context_->renderer(); }

 private:
  const Scene& scene_;
  std::unique_ptr<Context> context_;
  Backend backend_{};
  const RayScene* rays_ = nullptr;
  std::optional<T> kept_;
};

}  // namespace penumbra::gl
