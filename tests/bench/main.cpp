// What accuracy costs in time: `./run bench [PART [SCENE...]] [--write]`. Figures are printed and, with
// --write, kept as data.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

struct Part {
  const char* name;
  void (*run)(Record& record, const SceneNames& scenes);
  SceneNames scenes;  ///< measured where none is named
};

/// One mesh of data/meshes among them.
SceneNames solid_scenes() {
  return {"cube-small",
          "cube-medium",
          "sphere-small",
          "sphere-medium",
          "torus-small",
          "torus-medium",
          "boxes-small",
          "boxes-medium",
          "triangle-small",
          "triangle-medium",
          "speck-small",
          "speck-medium",
          "bunny-small",
          "bunny-medium",
          "bunny-sun",
          "knot1-small",
          "knot1-medium",
          "armadillo-small",
          "armadillo-medium",
          "refined_elephant-small",
          "refined_elephant-medium",
          "decorativePlant-small",
          "decorativePlant-medium",
          "building",
          "dog-house.ply"};
}

const std::vector<Part>& parts() {
  static const std::vector<Part> all{
      {"price", bench_price, {}},
      {"volumes",
       bench_volumes,
       {"cube-medium", "sphere-medium", "torus-medium", "bunny-medium", "knot1-medium", "armadillo-medium",
        "refined_elephant-medium"}},
      {"accuracy",
       bench_accuracy,
       {"cube-small", "cube-medium", "cube-large", "sphere-medium", "torus-medium", "torus-large",
        "boxes-medium", "boxes-large", "bunny-medium", "knot1-medium", "armadillo-medium",
        "refined_elephant-medium", "foliage-medium", "decorativePlant-medium", "figure7"}},
      {"dbuffer", bench_d_buffer, {"cube-medium", "bunny-medium", "knot1-medium", "armadillo-medium"}},
      {"dbuffer-judge",
       bench_d_buffer_judge,
       {"cube-small", "cube-medium", "cube-large", "sphere-medium", "torus-medium", "torus-large",
        "triangle-small", "speck-small", "boxes-medium", "boxes-large", "bunny-small", "bunny-medium",
        "knot1-medium", "armadillo-medium", "refined_elephant-medium", "foliage-medium",
        "decorativePlant-medium", "figure7"}},
      {"dbuffer-check", bench_d_buffer_check, {}},
      {"silhouette",
       bench_silhouette,
       {"cube-medium", "sphere-medium", "torus-medium", "boxes-medium", "triangle-medium", "speck-medium",
        "bunny-medium", "knot1-medium", "armadillo-medium", "refined_elephant-medium", "foliage-medium",
        "decorativePlant-medium", "building", "tree"}},
      {"frames", bench_frames, {"cube-medium", "bunny-medium", "armadillo-medium"}},
      {"pops", bench_pops, {"cube-medium", "bunny-medium", "armadillo-medium", "foliage-medium"}},
      {"solids", bench_solids, solid_scenes()},
      {"solids-judge", bench_solids_judge, solid_scenes()},
      {"fields", bench_fields, {"bunny-small", "bunny-medium", "bunny-large", "bunny-sun"}},
      {"judge", bench_judge, {}},
      {"sun", bench_sun, {}},
      {"terrain", bench_terrain, {"500", "1000", "2000", "4000"}},
      {"growth", bench_growth, {}},
      {"occlusion", bench_occlusion_textures, {}}};
  return all;
}

struct Arguments {
  std::string part = "all", file, commit = "unknown";
  SceneNames scenes;
};

/// Exits with 2 where an option has no value.
Arguments parse(int argc, char** argv) {
  Arguments arguments;
  bool named = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--write" || word == "--commit") {
      if (i + 1 == argc) {
        std::fprintf(stderr, "penumbra_bench: %s needs a value\n", word.c_str());
        std::exit(2);
      }
      (word == "--write" ? arguments.file : arguments.commit) = argv[++i];
    } else if (!named) {
      arguments.part = word;
      named = true;
    } else {
      arguments.scenes.push_back(word);
    }
  }
  return arguments;
}

void print_help() {
  std::puts("penumbra_bench [PART [SCENE...]] [--write FILE] [--commit TEXT]\nParts:");
  for (const Part& part : parts()) std::printf("  %s\n", part.name);
  std::puts(
      "  all\nScenes are those of data/scenes. --write puts the figures into FILE (JSON), --commit says of "
      "which commit.");
}

/// Returns the exit code. Parts are written whole, so that all their figures are of one run. Throws what
/// loading, rendering and writing throw.
int run(const Arguments& arguments) {
  if (!arguments.file.empty() && !arguments.scenes.empty()) {
    std::fprintf(stderr, "penumbra_bench: --write keeps whole parts; name no scenes\n");
    return 2;
  }
  Record record;
  bool known = false;
  for (const Part& part : parts()) {
    if (arguments.part != "all" && arguments.part != part.name) continue;
    known = true;
    record.begin(part.name);
    part.run(record, arguments.scenes.empty() ? part.scenes : arguments.scenes);
    if (!arguments.file.empty()) record.write(arguments.file, arguments.commit);
  }
  if (known) return 0;
  std::fprintf(stderr, "penumbra_bench: no part \"%s\"; see --help\n", arguments.part.c_str());
  return 2;
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  using namespace penumbra::bench;
  const Arguments arguments = parse(argc, argv);
  if (arguments.part == "--help" || arguments.part == "-h") {
    print_help();
    return 0;
  }
  try {
    return run(arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "penumbra_bench: %s\n", e.what());
    return 1;
  }
}
