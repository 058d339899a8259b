#include <algorithm>
#include <array>
#include <cmath>

#include "tests/yardstick/judging.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

struct Sun {
  const char* name;
  double distance;
};
// At 1e1 and 1e2 the light's rays are not nearly parallel.
constexpr std::array<Sun, 5> kSuns{
    {{"sun_1e3", 1e3}, {"sun_1e4", 1e4}, {"sun_1e6", 1e6}, {"sun_1e8", 1e8}, {"sun_1e11", 1e11}}};

// Over pixels of the same face, of which one picture or the other has penumbra.
double mean_difference(const RenderResult& a, const RenderResult& b) {
  double sum = 0.0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.surface.size(); ++i) {
    if (!a.surface.hit(i) || a.surface.object[i] != b.surface.object[i] ||
        a.surface.face[i] != b.surface.face[i])
      continue;
    const double v = a.lights.front().visibility[i], w = b.lights.front().visibility[i];
    if ((v == 0.0 || v == 1.0) && v == w) continue;
    sum += std::abs(v - w);
    ++pixels;
  }
  return pixels > 0 ? sum / static_cast<double>(pixels) : 0.0;
}

}  // namespace

// A point at distance 1 from the axis through the scene sees a disk at distance D move by 1/(D tan(angle/2)) of its radius:
// the difference to the distant light falls like 1/D.
void judge_suns(Report& report) {
  if (!report.wants("suns")) return;
  JudgedScene distant(scene_named("sun_distant"), {480, 360});
  for (Contender method : contenders()) {
    if (method.is_hard || method.is_relative || !distant.takes(method)) continue;
    // Rays of the same seed: noise is the same where the geometry is.
    const RenderResult limit = distant.draw(method);
    std::array<double, kSuns.size()> difference{};
    for (std::size_t k = 0; k < kSuns.size(); ++k) {
      const std::string line = std::string("suns/") + kSuns[k].name + "/" + method.method;
      if (!report.wants(line)) continue;
      difference[k] =
          mean_difference(JudgedScene(scene_named(kSuns[k].name), {480, 360}).draw(method), limit);
      // That of 1e3 is what the geometry says; a fifth of it is saturated.
      const double expected = k == 0 ? 0.5 : 2.0 * difference[0] * kSuns[0].distance / kSuns[k].distance;
      report.add(line, difference[k] <= expected + 1e-4,
                 text("mean |V - V of the distant light| %.6f, at most %.6f expected", difference[k],
                      expected + 1e-4));
    }
  }
}

}  // namespace penumbra::yardstick
