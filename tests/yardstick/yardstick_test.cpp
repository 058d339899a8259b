// The yardstick in small: pictures at any scale that are known to be right, and that it sees what is wrong.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/yardstick/judging.h"
#include "tests/yardstick/moves.h"

namespace penumbra::yardstick {
namespace {

Contender small(const std::string& method) {
  Contender out = contender(method);
  out.size = {96, 72};
  return out;
}

void expect_right(const std::string& name, const std::string& method, const Move& move = {}) {
  JudgedScene scene(moved(scene_named(name), move));
  const Contender as = small(method);
  const Verdict& verdict = scene.verdict(as);
  EXPECT_TRUE(is_right(as, verdict, nullptr)) << name << ", " << method << ": " << text_of(verdict);
  EXPECT_GT(verdict.certified + verdict.penumbra, 0u);
}

TEST(Yardstick, SilhouettesAreRightAtAnyScale) {
  for (const char* name : {"ground_2e1", "ground_1e6", "sheet_1e-1", "sheet_1e-4", "lamp_in_wall_plane_1e-6",
                           "sun_1e2", "sun_1e8", "sun_1e11", "sun_distant"})
    expect_right(name, "silhouette");
}

TEST(Yardstick, ReferencesAreRightOnLargeFloorsAndUnderFarLights) {
  for (const char* name : {"ground_1e6", "sun_1e4", "sun_1e11"}) expect_right(name, "reference");
}

TEST(Yardstick, SilhouettesAreRightWhereScenesAreScaledMovedAndTurned) {
  const Move moves[] = {
      {.scale = 1e-9, .turn = turn_by_chance(1)},
      {.scale = 1e9, .turn = turn_by_chance(2)},
      {.turn = turn_by_chance(3), .shift = Vec3(2e7, -1e7, 3e7)},
  };
  for (const Move& move : moves) expect_right("ground_2e1", "silhouette", move);
}

TEST(Yardstick, SeesWhatIsWrong) {
  JudgedScene scene(scene_named("ground_2e1"));
  Contender none = small("silhouette");
  none.method = "none";
  const Verdict verdict = scene.verdict(none);
  EXPECT_GT(verdict.rmse, 0.1);
  EXPECT_EQ(verdict.most, 1.0);
  EXPECT_FALSE(is_right(none, verdict, nullptr));
  // Of two that keep their own error, that with an error of its own is right beside itself, and wrong beside
  // the other.
  none.is_relative = true;
  EXPECT_TRUE(is_right(none, verdict, &scene));
  Verdict better = verdict;
  better.rmse = 0.6 * verdict.rmse, better.rmse_of_all = 0.6 * verdict.rmse_of_all;
  EXPECT_TRUE(is_right(none, better, &scene));
  Verdict worse = verdict;
  worse.rmse = 1.6 * verdict.rmse;
  EXPECT_FALSE(is_right(none, worse, &scene));

  Verdict contradicted = scene.verdict(small("silhouette"));
  EXPECT_TRUE(is_right(small("silhouette"), contradicted, nullptr));
  contradicted.contradicted = 1;
  EXPECT_FALSE(is_right(small("silhouette"), contradicted, nullptr));
}

TEST(YardstickReport, FailsWhereARequiredCaseIsWrongOrMissing) {
  const auto conclude = [](bool one_is_wrong, bool one_is_missing, std::vector<std::string> patterns = {}) {
    Report report(std::move(patterns), {"a/*/m", "b/c/m"});
    report.add("a/1/m", true, "");
    report.add("a/2/m", !one_is_wrong, "");
    report.add("a/2/other", false, "not required");
    if (!one_is_missing) report.add("b/c/m", true, "");
    return report.conclude();
  };
  EXPECT_EQ(conclude(false, false), 0);
  EXPECT_EQ(conclude(true, false), 1);
  EXPECT_EQ(conclude(false, true), 1);
  EXPECT_EQ(conclude(false, true, {"a"}), 0) << "it was not wanted";
  EXPECT_EQ(conclude(true, true, {"a"}), 1);
}

TEST(YardstickReport, PatternsMatchWordsAtTheSamePlace) {
  const Report report({"cases/ground_*/silhouette", "moves"}, {});
  for (const char* name : {"cases", "cases/ground_1e4", "cases/ground_1e4/silhouette", "moves", "moves/a/b"})
    EXPECT_TRUE(report.wants(name)) << name;
  for (const char* name : {"suns", "cases/stray", "cases/ground_1e4/hard"})
    EXPECT_FALSE(report.wants(name)) << name;
  EXPECT_TRUE(Report({}, {}).wants("suns/a/b"));
}

}  // namespace
}  // namespace penumbra::yardstick
