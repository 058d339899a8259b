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

constexpr double kRounding = 1e-4;

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

// Rays of the same seed: noise is the same where the geometry is.
void judge_suns_of(Report& report, const Contender& method) {
  JudgedScene distant(scene_named("sun_distant"));
  if (!distant.takes(method)) return;
  const RenderResult limit = distant.draw(method);
  double first = 0.0;
  for (const Sun& sun : kSuns) {
    const double difference = mean_difference(JudgedScene(scene_named(sun.name)).draw(method), limit);
    if (first == 0.0) first = difference;
    // That at 1e3 is some part of the penumbra; the others have twice what it says, since a part of it is
    // saturated.
    const bool is_first = sun.distance == kSuns.front().distance;
    const double expected = is_first ? 0.5 : 2.0 * first * kSuns.front().distance / sun.distance + kRounding;
    report.add(std::string("suns/") + sun.name + "/" + method.method, difference <= expected,
               text("mean |V - V of the distant light| %.6f, at most %.6f expected", difference, expected));
  }
}

}  // namespace

// A point at distance 1 from the axis through the scene sees a disk at distance D move by 1/(D tan(angle/2))
// of its radius: the difference to the distant light falls like 1/D.
void judge_suns(Report& report) {
  for (const Contender& method : contenders()) {
    const std::string all = "suns/*/" + method.method;
    if (method.is_hard || method.is_relative || !report.wants(all)) continue;
    report.attempt(all, [&] { judge_suns_of(report, method); });
  }
}

}  // namespace penumbra::yardstick
