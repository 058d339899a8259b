// The state of an OpenGL context as it is when new, kept between the methods that share one.
#pragma once

#include "render/gl/functions.h"

namespace penumbra::gl {

/// Resets what methods change (tests, culling, depth, clip control, bindings, viewport aside) to OpenGL's own
/// defaults when it goes out of scope, also by an exception, so that no frame can depend on what another
/// method drew before. The context must still be current then.
class StateScope {
 public:
  explicit StateScope(const Functions& gl) : gl_(gl) {}
  ~StateScope();
  StateScope(const StateScope&) = delete;
  StateScope& operator=(const StateScope&) = delete;

 private:
  const Functions& gl_;
};

}  // namespace penumbra::gl
