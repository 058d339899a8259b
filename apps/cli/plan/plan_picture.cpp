#include "apps/cli/plan/plan_picture.h"

#include <algorithm>
#include <cstdio>

#include "penumbra/render/image/image.h"
#include "penumbra/render/method.h"
#include "render/rays/camera_rays.h"
#include "render/silhouette/edge_hierarchies.h"
#include "render/silhouette/silhouette_method.h"
#include "render/silhouette/silhouette_visibility.h"

namespace penumbra::apps {
namespace {

/// As the methods have them (silhouette_method.cpp).
SilhouetteOptions options_of(const LightPlan& plan) {
  const OptionValues options = completed(method_named(plan.method).options, plan.options);
  if (plan.method == "rays") return rays_certificates(options);
  return {.rows = static_cast<int>(integer_of(options, "silhouette-rows")),
          .tolerance = real_of(options, "silhouette-tolerance")};
}

}  // namespace

std::vector<Done> done_by(const Scene& scene, const LightShape& light, const LightPlan& plan, int width,
                          int height, int threads) {
  const RayScene rays(scene, threads);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, width, height);
  const bool is_method = plan.action == LightPlan::Action::kMethod;
  std::vector<Done> out(surface.size(), is_method ? Done::kRays : Done::kNothing);
  if (is_method && (plan.method == "silhouette" || plan.method == "rays")) {
    Scene casters = scene;
    for (const std::size_t object : plan.left_out) casters.objects[object].casts = false;
    detail::EdgeHierarchies hierarchies(casters);
    const SilhouetteResult seen =
        silhouette_visibility(casters, rays, hierarchies, light, surface.receivers(), options_of(plan));
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = seen.region[i] == 0 ? Done::kLit : seen.region[i] == 2 ? Done::kUmbra : Done::kArea;
    for (const std::uint32_t i : seen.open) out[i] = Done::kRays;
  }
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!surface.hit(i)) out[i] = Done::kNoSurface;
  return out;
}

void write_done(const std::filesystem::path& path, int width, int height, const std::vector<Done>& done) {
  std::vector<std::uint8_t> rgb;
  for (const Done each : done) {
    const auto& color = kDone[static_cast<std::size_t>(each)].color;
    rgb.insert(rgb.end(), color.begin(), color.end());
  }
  write_png(path, width, height, rgb);
}

std::string shares_of(const std::vector<Done>& done) {
  std::array<std::size_t, kDone.size()> counts{};
  for (const Done each : done) ++counts[static_cast<std::size_t>(each)];
  const auto surface = static_cast<double>(std::max<std::size_t>(1, done.size() - counts[0]));
  std::string text;
  for (std::size_t k = 1; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    char line[96];
    std::snprintf(line, sizeof line, "  %-22s %5.1f %% of pixels\n", kDone[k].words,
                  100.0 * static_cast<double>(counts[k]) / surface);
    text += line;
  }
  return text;
}

}  // namespace penumbra::apps
