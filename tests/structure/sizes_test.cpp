// Folders and files stay small enough to be read: at most 25 files a folder, 350 lines a file.
// docs/architecture.md names the files that are longer, and why.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr int kMostFiles = 25, kMostLines = 350;
const std::string kHeading = "long files, and why";

using Counts = std::map<std::string, int>;  ///< by path

struct Sizes {
  Counts lines, files;  ///< of a file, in a folder
};

int lines_of(const fs::path& path) {
  std::ifstream in(path);
  return static_cast<int>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
}

Sizes sizes_of(const fs::path& top) {
  Sizes sizes;
  for (const char* module : {"mesh", "volumes", "render", "apps", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(top / module)) {
      if (!entry.is_regular_file()) continue;
      const fs::path path = fs::relative(entry.path(), top);
      ++sizes.files[path.parent_path().generic_string()];
      static const std::set<std::string> kText = {".h", ".cpp", ".glsl", ".cmake", ".txt", ".py"};
      if (kText.contains(path.extension().string()))
        sizes.lines[path.generic_string()] = lines_of(entry.path());
    }
  return sizes;
}

/// The paths in the first column of the table under the heading: lines `| file | why |`, the file in
/// backquotes. A row without a reason does not count.
std::set<std::string> named_in_table(std::istream& text) {
  static const std::regex kRow(R"(\|\s*`([^`]+)`\s*\|\s*(\S.*\S)\s*\|\s*)");
  std::set<std::string> out;
  bool below_heading = false;
  std::smatch match;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('#')) {
      std::ranges::transform(line, line.begin(), [](unsigned char c) { return std::tolower(c); });
      below_heading = line.ends_with(kHeading);
    } else if (below_heading && std::regex_match(line, match, kRow)) {
      out.insert(match[1]);
    }
  }
  return out;
}

/// What is larger than `most` and not in `excused`, and what is in `excused` without need.
std::vector<std::string> findings(const Counts& counts, int most, const std::set<std::string>& excused) {
  std::vector<std::string> out;
  for (const auto& [path, count] : counts)
    if (count > most && !excused.contains(path)) out.push_back(path + " has " + std::to_string(count));
  for (const std::string& path : excused) {
    const auto found = counts.find(path);
    if (found == counts.end() || found->second <= most) out.push_back(path + " needs no row");
  }
  return out;
}

TEST(Sizes, FoldersAreSmall) {
  const Sizes sizes = sizes_of(PENUMBRA_SOURCE);
  ASSERT_GT(sizes.files.size(), 30u);
  for (const std::string& finding : findings(sizes.files, kMostFiles, {}))
    ADD_FAILURE() << finding << " files; at most " << kMostFiles
                  << " are read at a glance: divide the folder";
}

TEST(Sizes, FilesAreShort) {
  const Sizes sizes = sizes_of(PENUMBRA_SOURCE);
  ASSERT_GT(sizes.lines.size(), 300u);
  std::ifstream in(fs::path(PENUMBRA_SOURCE) / "docs/architecture.md");
  ASSERT_TRUE(in) << "docs/architecture.md cannot be read";
  for (const std::string& finding : findings(sizes.lines, kMostLines, named_in_table(in)))
    ADD_FAILURE() << finding << " lines (table \"" << kHeading << "\" of docs/architecture.md; at most "
                  << kMostLines << ')';
}

TEST(SizeRules, CanFail) {
  const Counts counts = {{"a", kMostLines}, {"b", kMostLines + 1}};
  EXPECT_EQ(findings(counts, kMostLines, {}), std::vector<std::string>{"b has 351"});
  EXPECT_EQ(findings(counts, kMostLines, {"b"}), std::vector<std::string>{});
  EXPECT_EQ(findings(counts, kMostLines, {"a", "b"}), std::vector<std::string>{"a needs no row"});
  EXPECT_EQ(findings(counts, kMostLines, {"b", "c"}), std::vector<std::string>{"c needs no row"});
}

TEST(SizeRules, ReadTheTableUnderItsHeading) {
  std::istringstream text(
      "# Architecture\n| `no.cpp` | another table |\n"
      "## Long files, and why\n\n| file | why |\n|---|---|\n| `a/b.cpp` | one walk |\n| `c.h` | |\n| d.h | "
      "no quotes |\n"
      "## Next\n| `e.h` | too late |\n");
  EXPECT_EQ(named_in_table(text), std::set<std::string>{"a/b.cpp"});
}

}  // namespace
