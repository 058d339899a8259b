// What the tests of the D-buffer share.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "render/d_buffer/d_buffer.h"
#include "tests/render/error_support.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

/// One context for all tests: it takes a while to start.
inline gl::Context& d_buffer_context() {
  static const std::unique_ptr<gl::Context> shared = gl::make_context(gl::Backend::kOsMesa);
  return *shared;
}

/// One frame of a new D-buffer, under the scene's first light.
inline DBufferFrame draw_d_buffer(const Scene& scene, const SurfaceBuffer& surface,
                                  const DBufferOptions& options = {}) {
  const RayScene rays(scene, 0);
  DBuffer buffer(d_buffer_context(), scene, rays);
  buffer.set_surface(surface.receivers());
  return buffer.render(light_of(scene), options);
}

inline ::testing::AssertionResult all_in_range(const Values& visibility) {
  for (std::size_t i = 0; i < visibility.size(); ++i)
    if (!(visibility[i] >= 0.0f && visibility[i] <= 1.0f + 1e-6f))
      return ::testing::AssertionFailure() << "visibility " << visibility[i] << " at pixel " << i;
  return ::testing::AssertionSuccess();
}

/// RMSE over the true penumbra of `pixels`, by two references of 256 samples.
inline ErrorFigures error_over_penumbra(const View& view, const Values& visibility, const Pixels& pixels) {
  const Pixels near = view.near_penumbra(pixels);
  return penumbra_error(at_pixels(visibility, near), view.trace(near, 256, 21), view.trace(near, 256, 22));
}

}  // namespace penumbra::testing
