// Options that several subcommands share.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace CLI {
class App;
}

namespace penumbra::apps {

struct CommonOptions {
  int threads = 0;  ///< 0: all cores
  bool verbose = false;
};
void add_common_options(CLI::App& command, CommonOptions& options);

/// How many threads are used where so many are asked for.
int used_threads(int threads);

/// Holds every parallel loop of the program to `threads` while it lives; 0 leaves all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

struct SceneInput {
  std::filesystem::path path;
  bool strict = false;  ///< unknown keys are errors
  /// Of lights in glTF files.
  std::optional<double> light_radius{}, sun_angle{};
  /// Of glTF files; commands that use texture coordinates have an option for it.
  std::optional<int> uv_set{};
};
/// For CLI::Option::check: CLI11's own checks of ranges let NaN through.
std::string require_finite(const std::string& text);
void add_strict_option(CLI::App& command, SceneInput& input);
/// SCENE as a positional argument, --strict, --light-radius and --sun-angle.
void add_scene_input(CLI::App& command, SceneInput& input);
inline constexpr const char* kStandardInput = "standard input";
/// All of it. Throws SceneError where it is empty.
std::string read_standard_input();
/// Loads the scene, from standard input where the path is "-"; warnings go to standard error.
Scene load(const SceneInput& input);

/// --exposure, in stops.
void add_exposure_option(CLI::App& command, double& stops, const std::string& help);

struct PixelPair {
  int x = 0, y = 0;
};
/// "640x480", both 1 to 16384. Throws UsageError.
PixelPair parse_size(const std::string& text);
/// "320,240", a pixel of an image of this size, (0, 0) at the top left. Throws UsageError.
PixelPair parse_pixel(const std::string& text, const PixelPair& size);

}  // namespace penumbra::apps
