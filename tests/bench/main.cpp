// What accuracy costs in time: `./run bench [PART [SCENE...]]`. Medians of interleaved frames, everything
// finished, one process.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tests/bench/bench_support.h"
#include "tests/bench/classify_price.h"
#include "tests/bench/occlusion_bench.h"

namespace {

/// Returns the exit code; throws what the scenes' loading throws.
int run(const std::string& part, const std::vector<std::string>& named) {
  using namespace penumbra::bench;
  const auto scenes = [&](const std::vector<std::string>& usual) { return named.empty() ? usual : named; };
  const auto wanted = [&](const char* name) { return part == "all" || part == name; };
  bool known = false;
  if (wanted("price")) compare_prices_of_classification(), known = true;
  if (wanted("dbuffer"))
    bench_d_buffer(scenes({"cube-medium", "bunny-medium", "knot1-medium", "armadillo-medium"})), known = true;
  if (wanted("accuracy")) {
    for (const std::string& name :
         scenes({"cube-small", "cube-medium", "cube-large", "sphere-medium", "torus-medium", "torus-large",
                 "boxes-medium", "boxes-large", "bunny-medium", "knot1-medium", "armadillo-medium",
                 "refined_elephant-medium", "foliage-medium", "decorativePlant-medium", "figure7"}))
      measure_accuracy(name);
    known = true;
  }
  if (wanted("silhouette")) {
    for (const std::string& name :
         scenes({"cube-medium", "sphere-medium", "torus-medium", "boxes-medium", "triangle-medium",
                 "speck-medium", "bunny-medium", "knot1-medium", "armadillo-medium",
                 "refined_elephant-medium", "foliage-medium", "decorativePlant-medium", "building", "tree"}))
      time_silhouettes(name);
    known = true;
  }
  if (wanted("growth")) time_silhouette_growth(), known = true;
  if (wanted("occlusion")) bench_occlusion_textures(), known = true;
  if (known) return 0;
  std::fprintf(
      stderr,
      "penumbra_bench: no part \"%s\"; there are price, accuracy, dbuffer, silhouette, growth, occlusion and "
      "all\n",
      part.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "all";
  if (part == "--help" || part == "-h") {
    std::puts(
        "penumbra_bench [PART [SCENE...]]: price, accuracy, dbuffer, silhouette, growth, occlusion or all; "
        "scenes of data/scenes");
    return 0;
  }
  try {
    return run(part, {argv + (argc > 1 ? 2 : 1), argv + argc});
  } catch (const std::exception& e) {
    std::fprintf(stderr, "penumbra_bench: %s\n", e.what());
    return 1;
  }
}
