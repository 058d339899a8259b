// Methods against the oracle: rays in double without offset, which share nothing with what they judge.
#include "apps/cli/comparison.h"
#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kPixels = 20'000;  // of those that see a surface, chosen by chance
constexpr int kOracleRays = 1'024;

struct JudgedMethod {
  const char* method;
  OptionValues options;
};
const std::vector<JudgedMethod>& judged_methods() {
  static const std::vector<JudgedMethod> all{
      {"silhouette", {}}, {"dbuffer", {}}, {"occlusion-textures", {}}, {"reference", {{"samples", std::uint64_t{4096}}}}};
  return all;
}

void add(Record& record, const std::string& name, const apps::Comparison& comparison) {
  record.add(name, "1", comparison.in_penumbra.rmse);
  record.add(name + "/at most", "1", comparison.in_penumbra.max_absolute);
  if (comparison.certified > 0)
    record.add(name + "/contradicted", "pixels", static_cast<double>(comparison.contradicted));
}

void measure(Record& record, const std::string& name) {
  Renderer renderer(bench_scene(name));
  apps::SceneComparison judge(renderer.scene(), {}, {.samples = kOracleRays, .oracle_pixels = kPixels});
  bool first = true;
  for (const auto& [method, options] : judged_methods()) {
    const RenderResult picture = renderer.render({.method = method, .options = options});
    const apps::Comparison comparison = judge.compare(picture.image);
    if (std::exchange(first, false))
      record.add(name + "/pixels in penumbra", "pixels", static_cast<double>(comparison.penumbra.size()));
    add(record, name + "/" + method, comparison);
  }
}

}  // namespace

void bench_judge(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) measure(record, name);
}

}  // namespace penumbra::bench
