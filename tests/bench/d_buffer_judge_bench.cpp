// The D-buffer by its options against the oracle: rays in double without offset, contact included.
#include "apps/cli/compare/comparison.h"
#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kPixels = 3'000;  // of those that see a surface, chosen by chance
constexpr int kOracleRays = 1'024;

struct Row {
  const char* name;
  OptionValues options{};
};

const std::vector<Row>& rows() {
  const auto word = [](const char* text) { return OptionValue(std::string(text)); };
  static const std::vector<Row> all{
      {"default"},
      {"two entries", {{"dbuffer-entries", 2u}}},
      {"no rays asked", {{"dbuffer-check", word("none")}}},
      {"furthest", {{"conflict", word("furthest")}, {"dbuffer-check", word("none")}}},
      {"the paper's",
       {{"dbuffer", word("distances")},
        {"visibility", word("smoothstep")},
        {"dbuffer-center", word("depth")},
        {"dbuffer-check", word("none")}}}};
  return all;
}

/// Pixels of true penumbra on what does not cast, and on casters.
struct Penumbra {
  std::vector<std::uint32_t> floor, casters;
  Penumbra(const Scene& scene, const SurfaceBuffer& surface, const apps::Comparison& judged) {
    for (const std::uint32_t i : judged.penumbra) {
      const bool casts = scene.objects[static_cast<std::size_t>(surface.object[i])].casts;
      (surface.object[i] == 0 || !casts ? floor : casters).push_back(i);
    }
  }
};

void measure(Record& record, const std::string& name) {
  Renderer renderer(bench_scene(name));
  apps::SceneComparison judge(renderer.scene(), {}, {.samples = kOracleRays, .oracle_pixels = kPixels});
  for (const Row& row : rows()) {
    const RenderResult picture = renderer.render({.method = "dbuffer", .options = row.options});
    const apps::Comparison judged = judge.compare(picture.image);
    const Penumbra penumbra(renderer.scene(), picture.surface, judged);
    record.set_renderer(picture.lights.front().renderer);
    if (&row == rows().data())
      record.add(name + "/pixels in penumbra", "pixels", static_cast<double>(judged.penumbra.size()));
    const auto rmse = [&](const std::vector<std::uint32_t>& pixels) {
      return pixels.empty()
                 ? 0.0
                 : error_figures(picture.lights.front().visibility, judged.first, judged.second, pixels).rmse;
    };
    record.add(name + "/" + row.name + "/RMSE floor", "1", rmse(penumbra.floor));
    record.add(name + "/" + row.name + "/RMSE casters", "1", rmse(penumbra.casters));
    record.add(name + "/" + row.name + "/at most", "1", judged.in_penumbra.max_absolute);
  }
}

}  // namespace

void bench_d_buffer_judge(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) measure(record, name);
}

}  // namespace penumbra::bench
