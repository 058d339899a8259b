// What accuracy costs in time: `./run bench [PART [SCENE...]]`. Medians of interleaved frames, everything
// finished, one process.
#include <cstdio>
#include <string>
#include <vector>

#include "tests/bench/bench_support.h"
#include "tests/bench/classify_price.h"
#include "tests/bench/occlusion_bench.h"

int main(int argc, char** argv) {
  using namespace penumbra::bench;
  const std::string part = argc > 1 ? argv[1] : "all";
  const std::vector<std::string> named(argv + (argc > 1 ? 2 : 1), argv + argc);
  const auto scenes = [&](const std::vector<std::string>& usual) { return named.empty() ? usual : named; };
  const auto wanted = [&](const char* name) { return part == "all" || part == name; };
  bool known = false;
  if (wanted("price")) compare_prices_of_classification(), known = true;
  if (wanted("dbuffer"))
    bench_d_buffer(scenes({"cube-medium", "bunny-medium", "knot1-medium", "armadillo-medium"})), known = true;
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
      "penumbra_bench: no part \"%s\"; there are price, dbuffer, silhouette, growth, occlusion and all\n",
      part.c_str());
  return 2;
}
