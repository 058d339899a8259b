#include "apps/common/options.h"

#include <tbb/global_control.h>
#include <unistd.h>

#include <thread>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <iostream>
#include <iterator>
#include <optional>

#include "apps/common/messages.h"
#include "apps/common/outputs.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::apps {
namespace {

constexpr int kMaxSide = 16'384;

// Decimal digits and nothing else.
std::optional<int> parse_natural(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && text.front() != '-' ? std::optional(value) : std::nullopt;
}

std::optional<PixelPair> parse_pair(const std::string& text, char separator) {
  const auto middle = text.find(separator);
  if (middle == std::string::npos) return std::nullopt;
  const auto x = parse_natural(std::string_view(text).substr(0, middle));
  const auto y = parse_natural(std::string_view(text).substr(middle + 1));
  return x && y ? std::optional(PixelPair{*x, *y}) : std::nullopt;
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--threads", options.threads, "Threads to use; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str()
      ->group("General");
  command
      .add_flag("-v,--verbose", options.verbose, "Say on standard error what is done and how long it takes")
      ->group("General");
}

int used_threads(int threads) {
  return threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
}

struct ThreadLimit::Control {
  explicit Control(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(threads > 0 ? std::make_unique<Control>(threads) : nullptr) {}
ThreadLimit::~ThreadLimit() = default;

std::string require_finite(const std::string& text) {
  double value = 0.0;
  return CLI::detail::lexical_cast(text, value) && std::isfinite(value) ? "" : text + " is no finite number";
}

void add_strict_option(CLI::App& command, SceneInput& input) {
  command.add_flag("--strict", input.strict, "Unknown keys of the scene file are errors, not warnings")
      ->group("General");
}

void add_scene_input(CLI::App& command, SceneInput& input) {
  command
      .add_option("SCENE", input.path,
                  "Scene file (*.json), glTF (*.gltf, *.glb) or bare mesh (" + mesh_format_names() +
                      "); - is standard input")
      ->required();
  add_strict_option(command, input);
  command
      .add_option("--light-radius", input.light_radius,
                  "Radius of point and spot lights of glTF, scene units")
      ->check(require_finite)
      ->check(CLI::NonNegativeNumber)
      ->group("General");
  command.add_option("--sun-angle", input.sun_angle, "Angle of directional lights of glTF, degrees")
      ->check(require_finite)
      ->check(CLI::Range(0.0, 179.0))
      ->group("General");
}

std::string read_standard_input() {
  if (isatty(STDIN_FILENO)) complain("reading standard input; end it with Ctrl-D");
  std::string bytes{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  if (bytes.empty()) throw SceneError(std::string(kStandardInput) + ": is empty; give it a scene or a mesh");
  return bytes;
}

namespace {

/// Whether reading takes a second or more. Meshes that a scene names are not looked at.
bool is_large(const std::filesystem::path& path) {
  constexpr std::uintmax_t kMany = 20'000'000;  // bytes
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  return !error && bytes > kMany;
}

}  // namespace

Scene load(const SceneInput& input) {
  const LoadedScene loaded = [&] {
    const SceneOptions options = {.strict = input.strict,
                                  .light_radius = input.light_radius,
                                  .sun_angle = input.sun_angle,
                                  .uv_set = input.uv_set};
    if (is_standard(input.path))
      return parse_scene_or_mesh(read_standard_input(), "", kStandardInput, options);
    ProgressLine reading("reading " + input.path.string());
    if (is_large(input.path)) reading.begin();
    return load_scene(input.path, options);
  }();
  for (const std::string& warning : loaded.warnings) complain("warning: " + warning);
  return loaded.scene;
}

void add_exposure_option(CLI::App& command, double& stops, const std::string& help) {
  // Not CLI::Range, which lets NaN through.
  const auto in_range = [](const std::string& text) -> std::string {
    double value = 0.0;
    const bool good = CLI::detail::lexical_cast(text, value) && std::abs(value) <= 64.0;
    return good ? "" : text + " is no number of stops in [-64 - 64]";
  };
  command.add_option("--exposure", stops, help)->check(in_range)->capture_default_str();
}

PixelPair parse_size(const std::string& text) {
  const auto size = parse_pair(text, 'x');
  if (!size) throw UsageError("--size " + text + ": is no size; write WIDTHxHEIGHT, such as 640x480");
  if (size->x < 1 || size->y < 1 || size->x > kMaxSide || size->y > kMaxSide)
    throw UsageError("--size " + text + ": each side must be 1 to " + std::to_string(kMaxSide) + " pixels");
  return *size;
}

PixelPair parse_pixel(const std::string& text, const PixelPair& size) {
  const auto pixel = parse_pair(text, ',');
  if (!pixel) throw UsageError("--probe " + text + ": is no pixel; write X,Y, such as 320,240");
  if (pixel->x >= size.x || pixel->y >= size.y)
    throw UsageError("--probe " + text + ": lies outside the image of " + std::to_string(size.x) + "x" +
                     std::to_string(size.y) + " pixels; 0,0 is the top left one");
  return *pixel;
}

}  // namespace penumbra::apps
