// Nothing is moved off a surface, and no tolerance is in proportion to the scene: as far as words of the
// sources tell it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Rule {
  std::string name;
  std::regex pattern;
  std::string broken_by, kept_by;
};

const std::string kShift = "(?:offset|bias|epsilon|eps|nudge|step_?back|clearance)",
                  kAnyShift = "\\w*" + kShift + "\\w*";
const std::string kSize =
    "[\\w.()\\[\\]:>-]*(?:radius\\(\\)|extents?\\b|bounds\\w*|diagonal\\w*|longest_edge\\(\\)|scene_size)";
// Below 2^-18 a power of two is a bound of roundings in float.
const std::string kFraction = "(?:\\d*\\.?\\d*e-\\d+f?|0x1p-(?:\\d|1[0-7])f?)";

const std::vector<Rule>& rules() {
  const auto flags = std::regex::ECMAScript | std::regex::icase | std::regex::optimize;
  static const std::vector<Rule> kRules = {
      {"no offset of rays, receivers or lights",
       std::regex("\\b(?:k(?:Ray|Receiver|Light|Surface|Shadow|Normal|Self)\\w*|(?:ray|receiver|"
                  "surface|shadow|"
                  "normal|self)_)" +
                      kShift + "\\w*\\b",
                  flags),
       "const double start = kRayOffset * 2.0;", "const double start = kRayCount;"},
      {"nothing is moved along a normal",
       std::regex(
           "[-+]=?\\s*" + kAnyShift +
               "(?:\\(\\))?\\s*\\*\\s*[\\w.\\[\\]()>-]*normals?\\b|\\bnormal\\w*[\\w.\\[\\]()]*\\s*\\*\\s*" +
               kAnyShift,
           flags),
       "x += surface_bias * receivers.normals[i];", "return glm::dot(normal, p) - offset;"},
      {"no tolerance is a part of a size",
       std::regex(
           "(?:^|[^\\w.])" + kFraction + "\\s*\\*\\s*" + kSize + "|" + kSize + "\\s*\\*\\s*" + kFraction,
           flags),
       "if (distance < 1e-5 * scene.bounds().radius()) return;", "const double grain = 0x1p-20 * extent;"},
  };
  return kRules;
}

// Without comments and strings, so that words about offsets count for nothing.
std::string code_of(const std::string& text) {
  static const std::regex kNotCode(R"(//[^\n]*|"(?:[^"\\\n]|\\.)*")");
  return std::regex_replace(text, kNotCode, "");
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> findings(const std::string& code) {
  std::vector<std::string> out;
  for (const Rule& rule : rules())
    for (auto it = std::sregex_iterator(code.begin(), code.end(), rule.pattern); it != std::sregex_iterator();
         ++it)
      out.push_back(rule.name + ": " + it->str());
  return out;
}

/// Files that have such words, each with the reason.
const std::set<std::string> kExcused = {
    // Rays in single precision start off the surface.
    "render/scene/ray_frame.h",        "render/rays/ray_start.h",
    "render/rays/reference.cpp",       "render/silhouette/light_rays.cpp",
    "render/d_buffer/center_rays.cpp", "render/d_buffer/entries/facet_reach.cpp",
};

TEST(Scale, NothingIsMovedAndNoToleranceIsAPartOfTheScene) {
  std::size_t files = 0;
  for (const char* module : {"mesh", "volumes", "render"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PENUMBRA_SOURCE) / module)) {
      static const std::set<std::string> kSources = {".h", ".cpp", ".glsl"};
      if (!entry.is_regular_file() || !kSources.contains(entry.path().extension().string())) continue;
      ++files;
      const std::string name = fs::relative(entry.path(), PENUMBRA_SOURCE).generic_string();
      if (kExcused.contains(name)) continue;
      for (const std::string& finding : findings(code_of(text_of(entry.path()))))
        ADD_FAILURE() << name << ": " << finding;
    }
  EXPECT_GT(files, 200u);
}

TEST(ScaleRules, FailByTheirExamplesOnly) {
  for (const Rule& rule : rules()) {
    EXPECT_TRUE(std::regex_search(rule.broken_by, rule.pattern)) << rule.name;
    EXPECT_EQ(findings(rule.kept_by), std::vector<std::string>{}) << rule.name;
  }
  EXPECT_EQ(findings(code_of("// kRayOffset along the normal\nfail(\"1e-5 * bounds\");")),
            std::vector<std::string>{});
}

}  // namespace
