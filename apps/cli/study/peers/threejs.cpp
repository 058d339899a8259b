#include "apps/cli/study/peers/threejs.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "apps/cli/study/page/base64.h"
#include "apps/cli/study/peers/peer_text.h"
#include "apps/cli/study/peers/scene_export.h"
#include "apps/cli/study/peers/temporary_folder.h"
#include "apps/cli/study/run_program.h"
#include "mesh/io/write_file.h"

namespace penumbra::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMostSeconds = 600.0;
constexpr const char* kNames[] = {"chromium", "chromium-browser", "google-chrome"};

/// Empty where none can be run.
std::string chromium() {
  for (const char* name : kNames)
    if (run_program(name, {name, "--version"}, Stream::kOutput)) return name;
  return "";
}

fs::path library_of(const fs::path& three) {
  return three / "build" / "three.cjs";
}

std::string missing(const fs::path& three) {
  if (three.empty()) return "--three is not given, the folder of npm's package three";
  if (!fs::exists(library_of(three))) return library_of(three).string() + " is not there";
  return chromium().empty() ? "chromium cannot be run (Debian's package chromium)" : "";
}

std::vector<Setting> settings() {
  const auto setting = [](std::uint64_t map, std::uint64_t samples, const char* varied) {
    return Setting{
        .method = "threejs-pcss", .options = {{"map", map}, {"samples", samples}}, .varied = varied};
  };
  return {setting(1'024, 17, ""), setting(4'096, 17, "map"), setting(4'096, 64, "several")};
}

/// As part of a script: no text of it ends the element.
std::string script(std::string text) {
  for (std::size_t at = 0; (at = text.find("</script", at)) != std::string::npos; at += 9)
    text.replace(at, 2, "<\\/");
  return "<script>\n" + text + "\n</script>\n";
}

std::string page_of(const PeerCase& given, std::span<const Setting> settings, const fs::path& three) {
  std::ifstream in(library_of(three), std::ios::binary);
  const std::string library{std::istreambuf_iterator<char>(in), {}};
  json wanted = {{"scene", scene_export(given.seen)}, {"rounds", given.rounds}, {"settings", json::array()}};
  for (const Setting& setting : settings)
    wanted["settings"].push_back(
        {{"map", integer_of(setting.options, "map")}, {"samples", integer_of(setting.options, "samples")}});
  return "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<body>\n" +
         script("const THREE = (() => { const exports = {};\n" + library + "\nreturn exports; })();") +
         script("const given = " + wanted.dump() + ";") + script(std::string(peer_text("threejs.js"))) +
         "</body>\n";
}

/// What the page says when it is done.
json open_page(const fs::path& folder) {
  const std::string name = chromium();
  const auto text = run_program(
      name,
      {name, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
       "--enable-unsafe-swiftshader", "--user-data-dir=" + (folder / "profile").string(), "--dump-dom",
       "file://" + (folder / "page.html").string()},
      Stream::kOutput, kMostSeconds);
  if (!text) throw PeerError("Chromium failed");
  const std::string mark = "<pre id=\"result\">";
  const std::size_t from = text->find(mark), to = text->find("</pre>", from);
  if (from == std::string::npos || to == std::string::npos)
    throw PeerError("the page did not come to its end");
  json said = json::parse(text->substr(from + mark.size(), to - from - mark.size()), nullptr, false);
  if (said.is_discarded()) throw PeerError("the page's result is cut");
  if (said.contains("error")) throw PeerError(said["error"].get<std::string>());
  return said;
}

/// Rows of the page's pictures begin at the bottom.
std::vector<float> picture_of(const std::string& text, const Image& expected) {
  const std::string bytes = from_base64(text);
  std::vector<float> values(expected.at("A").size());
  if (bytes.size() != sizeof(float) * values.size()) throw PeerError("a picture is of another size");
  std::memcpy(values.data(), bytes.data(), bytes.size());
  for (int low = 0, high = expected.height - 1; low < high; ++low, --high)
    std::swap_ranges(values.begin() + low * expected.width, values.begin() + (low + 1) * expected.width,
                     values.begin() + high * expected.width);
  return values;
}

std::vector<Measured> measure(const PeerCase& given, std::span<const Setting> settings,
                              const fs::path& three) {
  const TemporaryFolder folder("threejs");
  const std::string page = page_of(given, settings, three);
  write_file(folder.path() / "page.html", [&page](std::ostream& out) { out << page; });
  const json said = open_page(folder.path());
  const std::vector<float> lit = picture_of(said.at("lit"), given.unshadowed), whole(lit.size(), 1.0f);
  const std::string renderer =
      "three.js r" + said.at("revision").get<std::string>() + " on " + said.at("renderer").get<std::string>();
  std::vector<Measured> out;
  for (const json& result : said.at("results"))
    out.push_back(peer_result(
        given, visibility_of_ratio(picture_of(result.at("shadowed"), given.unshadowed), lit, whole),
        result.at("times").get<std::vector<double>>(), "render", renderer));
  if (out.size() != settings.size()) throw PeerError("a setting is missing");
  return out;
}

}  // namespace

Peer threejs_peer(const fs::path& three) {
  return {.name = "threejs-pcss",
          .settings = settings(),
          .missing = [three] { return missing(three); },
          .takes_distant = true,
          .measure = [three](const PeerCase& given,
                             std::span<const Setting> settings) { return measure(given, settings, three); }};
}

}  // namespace penumbra::apps
