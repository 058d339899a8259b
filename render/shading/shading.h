// The last step of a picture, the same for every method: visibility → RGB.
//
// RGB = albedo/π · radiance · F · V/V_h for a diffuse receiver, summed over lights, with F the irradiance
// factor and V_h the area fraction of the part of the light above the receiver's tangent plane
// (light/light_integrals.h), and V the visibility. Radiance leaves a light's front side only. V_h = 0 gives
// 0.
//
// Beyond lights a picture has what its scene asks of it (scene/picture_settings.h): albedo · ambient · (3 +
// n·up) / 4 of fill light, which nothing hides; surfaces that fade with the distance from their middle; and
// shadow catchers, which are black and as opaque as the shadow is dark: A = 1 - Y(E with shadow) / Y(E
// without), E the irradiance and fill light together, Y its luminance. Under one light without fill light
// that is 1 - V/V_h. R G B are multiplied by A.
//
// Smooth shading: where an object has normals at its corners, F is taken for the normal between them instead.
// V and V_h are those of the flat face, so a face that is turned away from the light is dark although its
// smooth normal is not. So that no dark seam shows there, F is multiplied by s(min(1, F_flat / (F cos))), cos
// between both normals and s(x) = x + x² - x³, which falls to 0 with F_flat, and rises level to 1, which it
// is where the light lies along the smooth normal (Chiang, Li and Burley, "Taming the Shadow Terminator",
// 2019).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/render/image/image.h"
#include "penumbra/render/receivers/surface_buffer.h"
#include "penumbra/render/scene/scene.h"
#include "render/support/threads.h"

namespace penumbra {

/// What a method found out about one of the scene's lights, in their order.
struct LightVisibility {
  /// One a pixel.
  std::span<const float> visibility;
  /// One a pixel, or empty: then -1 (not certified) everywhere but behind the light's plane, where it is 2.
  std::span<const std::int8_t> region;
  /// Visibility is known to be 0 wherever there is a surface; both may then be empty.
  bool is_dark = false;
};

struct ShadeOptions {
  /// The image was for the same surface; object, P and N then stay as they are.
  bool has_surface = false;
  /// No channels for lights that are dark.
  bool leave_out_dark = false;
};

/// R G B A alone.
struct Colors {
  std::vector<float> r, g, b, a;
};

/// Every channel of a picture: R G B A, visibility and region, object, P and N. With several lights there is
/// a visibility.NAME and a region.NAME for each. Cost O(pixels · lights), of dark ones that of filling their
/// channels; on all threads.
Image shade(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
            const detail::Threads& threads);

/// The same into an image, whose memory is used again: one that an earlier call for the same scene and as
/// many pixels made.
void shade(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
           const detail::Threads& threads, const ShadeOptions& options, Image& image);

namespace detail {
/// The channels of dark lights.
void add_dark_channels(const Scene& scene, const SurfaceBuffer& surface,
                       std::span<const LightVisibility> lights, const Threads& threads, Image& image);
}  // namespace detail

/// What shade() gives for R G B A. Regions are not looked at.
Colors shade_colors(const Scene& scene, const SurfaceBuffer& surface, std::span<const LightVisibility> lights,
                    const detail::Threads& threads);

}  // namespace penumbra
