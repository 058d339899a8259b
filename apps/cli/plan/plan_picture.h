// penumbra plan --picture: what is done for each pixel, as colors.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "penumbra/render/plan/plan.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

/// What is done for a pixel, in the order of kDone.
enum class Done : std::uint8_t { kNoSurface, kNothing, kLit, kUmbra, kArea, kRays };

struct DoneColor {
  const char* words;
  std::array<std::uint8_t, 3> color;
};
inline constexpr std::array<DoneColor, 6> kDone{{{"no surface", {24, 24, 24}},
                                                 {"no shadow looked for", {170, 170, 170}},
                                                 {"certified lit", {240, 228, 180}},
                                                 {"certified umbra", {44, 58, 104}},
                                                 {"area", {44, 150, 100}},
                                                 {"rays", {222, 110, 40}}}};

/// One entry a pixel. Cost: a frame without its rays.
std::vector<Done> done_by(const Scene& scene, const LightShape& light, const LightPlan& plan, int width,
                          int height, int threads);

/// PNG, a color a pixel. Throws SystemError.
void write_done(const std::filesystem::path& path, int width, int height, const std::vector<Done>& done);

/// The share of the surface's pixels of each color, a line each.
std::string shares_of(const std::vector<Done>& done);

}  // namespace penumbra::apps
