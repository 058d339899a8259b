// D-buffer step 3: the image's receivers in light space.
//
// In: receivers in double, a light's space. Out: their places in it, in double; then, relative to a window,
// in float. Receivers are transformed for every light: what is far from the window keeps no digits, and what
// is in it all.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/d_buffer/view/light_space.h"
#include "render/d_buffer/view/uv_bounds.h"

namespace penumbra::detail {

/// What the shader takes of a receiver for each pixel, in the window's coordinates.
struct ReceiverTexels {
  /// (u, v, h), and 1 + the number of the face, counted over all objects of the scene; 0 where nothing is
  /// seen, negative where the receiver is not in front of the light.
  std::vector<glm::vec4> positions;
  /// The plane of the receiver's horizon (LightSpace::plane).
  std::vector<glm::vec4> planes;
};

class ReceiversInLight {
 public:
  /// `space` without a window. Refers to the receivers. Cost O(receivers), on all cores.
  ReceiversInLight(const Receivers& receivers, const LightSpace& space);

  /// Of all that are in front of the light.
  UvBounds bounds() const;
  /// A lower bound of h of those within; infinite without any. Cost O(receivers / 64).
  double lowest(const UvBounds& window) const;
  /// `first_face`: of each object the number of its first face. Cost O(receivers), on all cores.
  ReceiverTexels texels(const LightSpace& windowed, std::span<const std::uint32_t> first_face) const;

 private:
  struct Box {
    UvBounds uv;
    double low;
  };
  const Receivers& receivers_;
  /// Not a number: nothing is seen, or it is not in front of the light.
  std::vector<Uvh> places_;
  std::vector<Box> boxes_;
};

}  // namespace penumbra::detail
