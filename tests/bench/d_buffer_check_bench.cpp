// The D-buffer with and without its rays (step 8), at three sizes. The silhouette method is taken as the
// truth.
#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{160, 120}, {640, 480}, {1280, 960}};
constexpr double kNearlyNone = 1e-4;  // of the disk: above the silhouette method's own rounding

/// Root mean square errors: where the truth is penumbra; everywhere; in the penumbra of the picture's
/// outermost rows and columns, and of the three next to them.
struct Errors {
  double penumbra = 0.0, all = 0.0, border = 0.0, inside = 0.0;
};

class Mean {
 public:
  void add(double error) { squares_ += error * error, ++count_; }
  double root() const { return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0.0; }

 private:
  double squares_ = 0.0;
  std::size_t count_ = 0;
};

Errors errors_of(const SurfaceBuffer& surface, const std::vector<float>& truth,
                 const std::vector<float>& visibility) {
  Mean penumbra, all, border, inside;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!surface.hit(i)) continue;
    const double v = truth[i], error = visibility[i] - v;
    all.add(error);
    if (v < kNearlyNone || v > 1.0 - kNearlyNone) continue;
    penumbra.add(error);
    const int x = static_cast<int>(i) % surface.width, y = static_cast<int>(i) / surface.width;
    const int margin = std::min({x, y, surface.width - 1 - x, surface.height - 1 - y});
    if (margin < 4) (margin == 0 ? border : inside).add(error);
  }
  return {penumbra.root(), all.root(), border.root(), inside.root()};
}

void measure(Record& record, Renderer& renderer, const std::string& name, const Size& size) {
  const auto render = [&](const char* method, const char* check) {
    RenderOptions options{.method = method, .width = size.width, .height = size.height};
    if (check) options.options["dbuffer-check"] = std::string(check);
    return renderer.render(options);
  };
  const RenderResult truth = render("silhouette", nullptr);
  const std::string path = name + "/" + std::to_string(size.width) + "x" + std::to_string(size.height);
  for (const char* check : {"rays", "none"}) {
    const RenderResult picture = render("dbuffer", check);
    const MethodFrame& light = picture.lights.front();
    record.set_renderer(light.renderer);
    const Errors e = errors_of(picture.surface, truth.lights.front().visibility, light.visibility);
    const std::string row = path + "/" + check;
    record.add(row + "/RMSE", "1", e.penumbra);
    record.add(row + "/RMSE of all pixels", "1", e.all);
    record.add(row + "/RMSE of the border", "1", e.border);
    record.add(row + "/RMSE next to the border", "1", e.inside);
    const Count* sampled = find(light.counts, "sampled_pixels");
    record.add(row + "/sampled", "pixels", static_cast<double>(std::get<std::uint64_t>(sampled->value)));
  }
}

/// All scenes of data/scenes under disks and distant lights.
SceneNames all_scenes() {
  SceneNames out;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(PENUMBRA_DATA) / "scenes"))
    if (file.path().extension() == ".json" &&
        !std::holds_alternative<RectangleLight>(shape_of(load_scene(file.path()).scene)))
      out.push_back(file.path().stem().string());
  std::ranges::sort(out);
  return out;
}

}  // namespace

void bench_d_buffer_check(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes.empty() ? all_scenes() : scenes) {
    Renderer renderer(bench_scene(name));
    for (const Size& size : kSizes) measure(record, renderer, name, size);
  }
}

}  // namespace penumbra::bench
