#include "tests/yardstick/judging.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

#include "apps/cli/compare/judge.h"

namespace penumbra::yardstick {
namespace {

constexpr std::size_t kChanging = 8'000, kOthers = 2'000;
constexpr int kRays = 1'024, kFewRays = 16;
constexpr std::uint64_t kSeed = 11;
constexpr double kRelative = 1.5, kRelativeLeast = 0.001;

OptionValues samples(std::uint64_t count) {
  return {{"samples", count}};
}

/// Whether the light's center lies in the receiver's plane, as far as rounding tells: a hard shadow has no
/// value there.
bool is_grazed(const LightShape& light, const Vec3& point, const Vec3& normal) {
  constexpr double kRounding = 1e-9;
  const CircularLight circular = require_circular(light, "hard shadows");
  const Vec3 way = circular.is_distant() ? circular.center : circular.center - point;
  return std::abs(glm::dot(normal, way)) <= kRounding * glm::length(way);
}

/// Pixels whose V is partial or unlike that of a pixel beside, and some of the others; ascending. Nothing of
/// the methods has a share in the choice.
std::vector<std::uint32_t> choose_pixels(const Scene& scene, const PictureSize& size,
                                         std::optional<int> object, bool is_hard) {
  const LightShape& light = scene.lights.front().shape;
  const SurfaceBuffer surface = apps::surface_by_oracle(scene, size.width, size.height);
  std::vector<std::uint32_t> seen, changing, others;
  for (std::uint32_t i = 0; i < surface.size(); ++i)
    if (surface.hit(i) && !(is_hard && is_grazed(light, surface.position[i], surface.normal[i])))
      seen.push_back(i);
  const apps::Judge judge(scene, light);
  const std::vector<float> values = judge.visibility(surface, seen, kFewRays, kSeed);
  std::vector<float> visibility(surface.size(), -1.0f);
  for (std::size_t k = 0; k < seen.size(); ++k) visibility[seen[k]] = values[k];
  for (const std::uint32_t i : seen) {
    const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
    bool changes = visibility[i] > 0.0f && visibility[i] < 1.0f;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, size.height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, size.width - 1); ++u)
        changes = changes || visibility[static_cast<std::size_t>(v * size.width + u)] != visibility[i];
    if (!object || surface.object[i] == *object) (changes ? changing : others).push_back(i);
  }
  std::vector<std::uint32_t> chosen = apps::some_of(std::move(changing), kChanging);
  others = apps::some_of(std::move(others), kOthers);
  chosen.insert(chosen.end(), others.begin(), others.end());
  std::ranges::sort(chosen);
  return chosen;
}

// The light's center instead of the light.
struct Center {
  LightShape operator()(DiskLight light) const {
    light.radius = 0.0;
    return light;
  }
  LightShape operator()(DistantLight light) const {
    light.angle_degrees = 0.0;
    return light;
  }
  LightShape operator()(const RectangleLight& light) const {
    return DiskLight{light.center, light.normal, 0.0};
  }
};

}  // namespace

// What is not listed keeps its own error, or has that of 256 samples. Stratified rays are off by .0008 RMS at
// 4,096 samples and by .0066 at 256. A hard shadow's pixels are right or wrong: one in a thousand may be, at
// outlines.
std::vector<Contender> contenders() {
  constexpr PictureSize kFewer{320, 240};  // for rays, which take longer
  std::vector<Contender> out = {
      {.method = "silhouette", .limits = {0.001, 0.03}},
      {.method = "reference", .options = samples(4'096), .limits = {0.002, 0.03}, .size = kFewer},
      {.method = "rays", .options = samples(256), .limits = {0.01, 0.1}, .size = kFewer},
      {.method = "hard", .limits = {0.032, 1.0}, .is_hard = true, .size = kFewer},
  };
  register_drawing_methods();
  for (const MethodInfo& method : methods()) {
    if (method.name == "none" || method.name == "auto") continue;
    if (std::ranges::find(out, method.name, &Contender::method) != out.end()) continue;
    Contender more{.method = method.name, .is_relative = !method.converges};
    if (method.converges) more.limits = {0.01, 0.1}, more.size = kFewer;
    out.push_back(more);
  }
  return out;
}

Contender contender(const std::string& method) {
  const std::vector<Contender> all = contenders();
  return *std::ranges::find(all, method, &Contender::method);
}

std::string text_of(const Verdict& v) {
  if (!v.trouble.empty()) return v.trouble;
  std::string out = text("%5zu in penumbra, RMSE %.5f; of all %.5f, at most %.4f", v.penumbra, v.rmse,
                         v.rmse_of_all, v.most);
  if (v.certified > 0) out += text("; certificates %zu, wrong %zu", v.certified, v.contradicted);
  return out;
}

JudgedScene::JudgedScene(Scene scene, std::optional<int> relative_on)
    : renderer_(std::move(scene)), relative_on_(relative_on), with_point_light_(renderer_.scene()) {
  LightShape& shape = with_point_light_.lights.front().shape;
  shape = std::visit(Center{}, shape);
}

bool JudgedScene::takes(const Contender& contender) const {
  try {
    require_taken(method_named(contender.method), scene().lights.front().shape);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

RenderResult JudgedScene::draw(const Contender& contender) {
  return renderer_.render({.method = contender.method,
                           .options = contender.options,
                           .width = contender.size.width,
                           .height = contender.size.height});
}

apps::SceneComparison& JudgedScene::judge_for(const Contender& contender) {
  const Kind kind{contender.size, contender.is_hard, contender.is_relative ? relative_on_ : std::nullopt};
  std::unique_ptr<apps::SceneComparison>& judge = judges_[kind];
  if (!judge) {
    const Scene& judged = kind.is_hard ? with_point_light_ : scene();
    judge = std::make_unique<apps::SceneComparison>(
        judged, apps::Judged{.object = kind.object, .light = {}},
        apps::TraceOptions{.samples = kind.is_hard ? 1 : kRays,
                           .oracle_pixels = kChanging + kOthers,
                           .pixels = choose_pixels(judged, kind.size, kind.object, kind.is_hard)});
  }
  return *judge;
}

const Verdict& JudgedScene::verdict(const Contender& contender) {
  const auto [at, is_new] = verdicts_.try_emplace(contender.method);
  Verdict& out = at->second;
  if (!is_new) return out;
  try {
    const apps::Comparison comparison = judge_for(contender).compare(draw(contender).image);
    out.penumbra = comparison.penumbra.size();
    out.rmse = comparison.penumbra.empty() ? 0.0 : comparison.in_penumbra.rmse;
    out.rmse_of_all = comparison.all.rmse;
    out.most = comparison.all.max_absolute;
    out.certified = comparison.certified;
    out.contradicted = comparison.contradicted;
  } catch (const std::exception& e) {
    out.trouble = e.what();
  }
  return out;
}

bool is_right(const Contender& contender, const Verdict& verdict, JudgedScene* base) {
  if (!verdict.trouble.empty() || verdict.contradicted > 0) return false;
  if (!contender.is_relative) {
    const Limits& limits = contender.limits;
    return verdict.rmse <= limits.rmse && verdict.rmse_of_all <= limits.rmse && verdict.most <= limits.most;
  }
  const Verdict& usual = base->verdict(contender);
  return usual.trouble.empty() && verdict.rmse <= kRelative * usual.rmse + kRelativeLeast &&
         verdict.rmse_of_all <= kRelative * usual.rmse_of_all + kRelativeLeast;
}

void judge_all(Report& report, const std::string& name, JudgedScene& scene, JudgedScene* base,
               const std::vector<Contender>& methods) {
  for (const Contender& method : methods) {
    const std::string line = name + "/" + method.method;
    if (!report.wants(line) || !scene.takes(method)) continue;
    const Verdict& verdict = scene.verdict(method);
    report.add(line, is_right(method, verdict, base), text_of(verdict));
  }
}

Scene scene_named(const std::string& name) {
  const std::filesystem::path data(PENUMBRA_DATA);
  for (const char* folder : {"regressions/scenes", "scenes"})
    if (const auto file = data / folder / (name + ".json"); std::filesystem::exists(file))
      return load_scene(file).scene;
  throw UsageError("no scene " + name + " in data/regressions/scenes and data/scenes");
}

}  // namespace penumbra::yardstick
