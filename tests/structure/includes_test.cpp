// Arrows go down only: apps → render → volumes → mesh; and each outside library stays where it belongs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file, module, target;  ///< file and module relative to the source folder
};

bool is_source(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".cpp";
}

std::vector<Include> all_includes() {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  const fs::path root = PENUMBRA_SOURCE;
  for (const char* module : {"mesh", "volumes", "render", "apps"})
    for (const auto& entry : fs::recursive_directory_iterator(root / module)) {
      if (!is_source(entry.path())) continue;
      std::ifstream in(entry.path());
      std::smatch match;
      for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, match, pattern))
          includes.push_back({fs::relative(entry.path(), root).string(), module, match[1]});
    }
  return includes;
}

const std::map<std::string, int> kRank = {{"mesh", 0}, {"volumes", 1}, {"render", 2}, {"apps", 3}};

TEST(Includes, AreFound) {
  EXPECT_GT(all_includes().size(), 100u);
}

TEST(Includes, PointDown) {
  for (const Include& include : all_includes()) {
    const auto target = kRank.find(include.target.substr(0, include.target.find('/')));
    if (target == kRank.end()) continue;
    EXPECT_LE(target->second, kRank.at(include.module)) << include.file << " includes " << include.target;
  }
}

/// What links packages under the GPL is built on top of volumes, never the other way round.
TEST(Includes, VolumesDoNotNeedChecks) {
  const auto of_checks = [](const std::string& path) {
    return path.starts_with("volumes/checks") || path == "volumes/convex_umbra.h" ||
           path == "volumes/checks/validate.h" || path == "volumes/checks/repair.h";
  };
  for (const Include& include : all_includes())
    if (include.module == "volumes" && of_checks(include.target)) {
      EXPECT_TRUE(of_checks(include.file)) << include.file << " includes " << include.target;
    }
}

// An outside library, known by how its headers' paths begin, and the files that may include it.
struct Home {
  const char* prefix;
  std::vector<std::string> allowed;
};

TEST(Includes, OutsideLibrariesStayWhereTheyBelong) {
  const std::vector<Home> homes = {
      {"OpenMesh/", {"mesh/"}},
      {"CGAL/",
       {"volumes/predicates/", "volumes/cells/half_spaces", "volumes/cells/solid_shape", "volumes/checks/"}},
      {"GL/", {"render/gl/"}},
      {"EGL/", {"render/gl/"}},
      {"GLFW/", {"render/gl/", "apps/"}},
      {"embree3/", {"render/"}},
      {"OpenEXR/", {"render/"}},
      {"CLI/", {"apps/"}},
  };
  for (const Include& include : all_includes())
    for (const Home& home : homes) {
      if (!include.target.starts_with(home.prefix)) continue;
      const bool allowed =
          std::any_of(home.allowed.begin(), home.allowed.end(),
                      [&](const std::string& start) { return include.file.starts_with(start); });
      EXPECT_TRUE(allowed) << include.file << " includes " << include.target;
    }
}

}  // namespace
