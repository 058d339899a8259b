#include "apps/cli/study/peers/cycles.h"

#include <algorithm>
#include <fstream>

#include "apps/cli/study/peers/peer_text.h"
#include "apps/cli/study/peers/scene_export.h"
#include "apps/cli/study/peers/temporary_folder.h"
#include "apps/cli/study/run_program.h"
#include "mesh/io/write_file.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

constexpr double kMostSeconds = 1'200.0;

std::string missing() {
  return run_program("blender", {"blender", "--version"}, Stream::kOutput)
             ? ""
             : "blender cannot be run (Debian's package blender)";
}

std::vector<Setting> settings() {
  const auto setting = [](std::uint64_t samples, const char* weights, const char* varied) {
    return Setting{.method = "cycles",
                   .options = {{"samples", samples}, {"weights", std::string(weights)}},
                   .varied = varied};
  };
  return {setting(64, "even", ""), setting(16, "even", "samples"), setting(256, "even", "samples"),
          setting(64, "irradiance", "weights")};
}

/// As cycles.py has them.
std::string name_of(const Setting& setting) {
  return std::to_string(integer_of(setting.options, "samples")) + "-" + word_of(setting.options, "weights");
}

/// Renders all settings. What Blender says of them.
json render_all(const PeerCase& given, std::span<const Setting> settings,
                const std::filesystem::path& folder) {
  const auto write = [&folder](const char* name, std::string_view text) {
    write_file(folder / name, [text](std::ostream& out) { out << text; });
  };
  write("scene.json", scene_export(given.seen).dump());
  write("cycles.py", peer_text("cycles.py"));
  std::vector<std::string> words{"blender",
                                 "--background",
                                 "--factory-startup",
                                 "--python-exit-code",
                                 "1",
                                 "--python",
                                 (folder / "cycles.py").string(),
                                 "--",
                                 (folder / "scene.json").string(),
                                 folder.string(),
                                 std::to_string(given.threads),
                                 std::to_string(given.rounds)};
  for (const Setting& setting : settings) words.push_back(name_of(setting));
  if (!run_program("blender", words, Stream::kError, kMostSeconds)) throw PeerError("Blender failed");
  std::ifstream in(folder / "times.json");
  json said = json::parse(in, nullptr, false);
  if (said.is_discarded()) throw PeerError("Blender wrote no times");
  return said;
}

std::vector<float> read_white(const std::filesystem::path& path, const Image& expected) {
  Image image = read_exr(path);
  if (image.width != expected.width || image.height != expected.height)
    throw PeerError("Blender's picture is of another size");
  return image.at("G");
}

/// Of one setting's two pictures. Where points of the light weigh alike, one that is above the horizon and
/// that nothing hides adds the same everywhere: the most that is found. Points below the horizon add nothing
/// to either picture.
std::vector<float> visibility_of(const PeerCase& given, const Setting& setting,
                                 const std::filesystem::path& folder) {
  const std::string name = name_of(setting) + ".exr";
  const std::vector<float> shadowed = read_white(folder / ("shadowed-" + name), given.unshadowed);
  std::vector<float> lit = read_white(folder / ("lit-" + name), given.unshadowed);
  std::vector<float> horizon = given.unshadowed.at("visibility");
  if (word_of(setting.options, "weights") == "even") {
    lit.assign(lit.size(), *std::ranges::max_element(lit));
    horizon.assign(horizon.size(), 1.0f);
  }
  return visibility_of_ratio(shadowed, lit, horizon);
}

std::vector<Measured> measure(const PeerCase& given, std::span<const Setting> settings) {
  const TemporaryFolder folder("cycles");
  const json said = render_all(given, settings, folder.path());
  std::vector<Measured> out;
  for (const Setting& setting : settings)
    out.push_back(peer_result(given, visibility_of(given, setting, folder.path()),
                              said.at("times").at(name_of(setting)).get<std::vector<double>>(), "render",
                              "Cycles of Blender " + said.at("version").get<std::string>()));
  return out;
}

}  // namespace

Peer cycles_peer() {
  return {.name = "cycles",
          .settings = settings(),
          .missing = missing,
          .takes_distant = true,
          .measure = measure};
}

}  // namespace penumbra::apps
