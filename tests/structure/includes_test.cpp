// Which file includes which: the table of include_rules.cpp holds in the tree, and each of its rules can
// fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/structure/include_rules.h"

namespace penumbra::structure {
namespace {

std::set<std::string> listed_public_headers() {
  std::set<std::string> out;
  std::istringstream in(PENUMBRA_PUBLIC_HEADERS);
  for (std::string header; std::getline(in, header, ',');) out.insert(header);
  return out;
}

const Tree& tree() {
  static const Tree kTree = read_tree(PENUMBRA_SOURCE, listed_public_headers());
  return kTree;
}

bool exempts(const Exemption& exemption, const Finding& finding) {
  return exemption.rule == finding.rule && exemption.file == finding.file &&
         exemption.target == finding.target;
}

/// The tree without the includes that are exempted, all but one.
Tree tree_without_exempted(const Exemption* kept = nullptr) {
  Tree out = tree();
  std::erase_if(out.includes, [&](const Include& include) {
    return std::ranges::any_of(exemptions(), [&](const Exemption& e) {
      return &e != kept && e.file == include.file && e.target == target_of(include);
    });
  });
  return out;
}

std::vector<Finding> all_findings(const Tree& in) {
  std::vector<Finding> out = findings_of_table(in), more = findings_of_public_headers(in);
  out.insert(out.end(), more.begin(), more.end());
  for (const char* module : {"mesh", "volumes", "render"}) {
    more = findings_of_circles(in, module);
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

/// A tree in which exactly these files and public headers exist.
Tree made_up(const std::vector<Include>& includes, const std::set<std::string>& public_headers = {}) {
  Tree tree{{}, public_headers, includes};
  for (const Include& include : includes) {
    tree.files.insert(include.file);
    tree.files.insert(target_of(include));
  }
  return tree;
}

TEST(Includes, AreFound) {
  EXPECT_GT(tree().includes.size(), 1000u);
  EXPECT_GT(tree().files.size(), 300u);
  EXPECT_GT(tree().public_headers.size(), 10u);
  for (const std::string& header : tree().public_headers)
    EXPECT_TRUE(tree().files.contains(header)) << header;
}

TEST(Includes, FollowTheRules) {
  for (const Finding& finding : all_findings(tree_without_exempted())) ADD_FAILURE() << text_of(finding);
}

TEST(Includes, ExemptIsOnlyWhatTheListSays) {
  for (const Finding& finding : findings_of_table(tree()))
    EXPECT_TRUE(std::ranges::any_of(exemptions(), [&](const Exemption& e) { return exempts(e, finding); }))
        << text_of(finding);
}

TEST(Includes, NoExemptionIsLeftOver) {
  for (const Exemption& exemption : exemptions()) {
    const std::vector<Finding> findings = all_findings(tree_without_exempted(&exemption));
    EXPECT_TRUE(std::ranges::any_of(findings, [&](const Finding& f) { return exempts(exemption, f); }))
        << exemption.file << " no longer includes " << exemption.target
        << ": take it off the list of exemptions";
  }
}

TEST(IncludeRules, EachFailsByItsExample) {
  for (const Rule& rule : rules()) {
    const std::vector<Finding> findings = findings_of_table(made_up({rule.broken_by}));
    EXPECT_TRUE(std::ranges::any_of(findings, [&](const Finding& f) { return f.rule == rule.name; }))
        << rule.name;
  }
}

TEST(IncludeRules, AllowWhatPointsDown) {
  const std::vector<Include> includes = {
      {"apps/cli/render_command.cpp", "penumbra/render/renderer.h"},
      {"apps/viewer/panel.cpp", "apps/common/options.h"},
      {"apps/viewer/panel.cpp", "CLI/CLI.hpp", false},
      {"render/renderer.cpp", "render/d_buffer/d_buffer.h"},
      {"render/d_buffer/entries/tiles.cpp", "render/d_buffer/d_buffer.h"},
      {"render/d_buffer/d_buffer.cpp", "render/gl/program.h"},
      {"render/d_buffer/d_buffer.cpp", "render/receivers/receivers.h"},
      {"render/silhouette/areas/rows.cpp", "render/silhouette/edges/scene_edges.h"},
      {"render/rays/ray_scene.cpp", "embree3/rtcore.h", false},
      {"render/scene/scene_json.cpp", "nlohmann/json.hpp", false},
      {"volumes/predicates/predicates_exact.cpp", "CGAL/Gmpq.h", false},
      {"volumes/checks/repair.cpp", "penumbra/volumes/checks/repair.h"},
      {"mesh/io/ply.cpp", "mesh/vectors.h"},
  };
  for (const Finding& finding : findings_of_table(made_up(includes))) ADD_FAILURE() << text_of(finding);
}

TEST(IncludeRules, MethodsAreAllFoldersThatAreNotShared) {
  const auto rules_broken = [](const char* file, const char* target) {
    std::set<std::string> out;
    for (const Finding& finding : findings_of_table(made_up({{file, target}}))) out.insert(finding.rule);
    return out;
  };
  EXPECT_TRUE(rules_broken("render/smoothies/fins.cpp", "render/d_buffer/d_buffer.h")
                  .contains("no method includes another"));
  EXPECT_TRUE(rules_broken("render/rays/hard.cpp", "render/smoothies/fins.h")
                  .contains("what is shared includes no method"));
  EXPECT_TRUE(rules_broken("render/smoothies/fins.cpp", "render/smoothies/fins.h").empty());
  EXPECT_TRUE(rules_broken("render/smoothies/fins.cpp", "render/rays/ray_scene.h").empty());
}

TEST(IncludeRules, PublicHeadersAreToldFromInternalOnes) {
  const std::set<std::string> public_headers = {"mesh/types.h", "mesh/shapes.h"};
  const auto rules_broken = [&](const Include& include, bool there = true) {
    Tree tree = made_up({include}, public_headers);
    if (!there) tree.files.erase(target_of(include));
    std::string out;
    for (const Finding& finding : findings_of_public_headers(tree)) out += finding.rule + '\n';
    return out;
  };
  EXPECT_EQ(rules_broken({"mesh/shapes.h", "penumbra/mesh/types.h"}), "");
  EXPECT_EQ(rules_broken({"mesh/shapes.cpp", "mesh/vectors.h"}), "");
  EXPECT_EQ(rules_broken({"mesh/shapes.h", "vector", false}, false), "");
  EXPECT_EQ(rules_broken({"mesh/shapes.cpp", "mesh/types.h"}), "public headers have the prefix\n");
  EXPECT_EQ(rules_broken({"mesh/shapes.cpp", "penumbra/mesh/vectors.h"}),
            "internal headers have no prefix\n");
  EXPECT_EQ(rules_broken({"mesh/shapes.h", "mesh/vectors.h"}), "public headers include public ones\n");
  EXPECT_EQ(rules_broken({"mesh/shapes.cpp", "vectors.h"}, false),
            "what is included is there, from the top\n");
}

TEST(IncludeRules, CirclesAreFound) {
  const Include down = {"render/rays/reference.h", "render/receivers/receivers.h"};
  const Include further = {"render/receivers/receivers.h", "penumbra/render/scene/scene.h"};
  const Include up = {"render/scene/scene.cpp", "render/rays/ray_scene.h"};
  EXPECT_TRUE(findings_of_circles(made_up({down, further}), "render").empty());
  EXPECT_EQ(findings_of_circles(made_up({down, further, up}), "render").size(), 3u);
  EXPECT_TRUE(findings_of_circles(made_up({down, further, up}), "volumes").empty());
  const Include own = {"render/renderer.h", "render/rays/reference.h"};
  const Include back = {"render/rays/reference.cpp", "render/renderer.h"};
  EXPECT_TRUE(findings_of_circles(made_up({own, back}), "render").empty());
}

}  // namespace
}  // namespace penumbra::structure
