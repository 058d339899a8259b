// penumbra study: which settings there are, what is written, and that a second call measures only what is
// missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/cli/study/measure/measure.h"
#include "apps/cli/study/settings.h"
#include "apps/cli/study/study_record.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Json = nlohmann::json;

OptionSchema schema(OptionDomain domain, OptionValue usual) {
  return {.name = "some-option", .domain = std::move(domain), .usual = std::move(usual), .help = "help"};
}

std::vector<std::string> texts(const std::vector<OptionValue>& values) {
  std::vector<std::string> out;
  for (const OptionValue& value : values) out.push_back(to_text(value));
  return out;
}

using Texts = std::vector<std::string>;

TEST(StudySettings, StepsFollowTheDomain) {
  EXPECT_EQ(texts(apps::steps_of(schema(IntegerRange{1, 1u << 20}, std::uint64_t{256}))),
            (Texts{"1", "4", "16", "64", "256", "1024", "4096"}));
  EXPECT_EQ(texts(apps::steps_of(schema(IntegerRange{4, 1024}, std::uint64_t{64}))),
            (Texts{"4", "16", "64", "256", "1024"}));
  EXPECT_EQ(texts(apps::steps_of(schema(IntegerChoice{{4, 8, 12}}, std::uint64_t{8}))),
            (Texts{"4", "8", "12"}));
  EXPECT_EQ(texts(apps::steps_of(schema(RealRange{0.0, 0.1}, 0.004))),
            (Texts{"0", "1.5625e-05", "6.25e-05", "0.00025", "0.001", "0.004", "0.016", "0.064"}));
  EXPECT_EQ(texts(apps::steps_of(schema(WordChoice{{"a", "b"}}, std::string("a")))), (Texts{"a", "b"}));
  OptionSchema given = schema(IntegerRange{0, 99}, std::uint64_t{0});
  given.steps = std::vector<OptionValue>{std::uint64_t{7}};
  EXPECT_EQ(texts(apps::steps_of(given)), Texts{"7"});
}

TEST(StudySettings, AreOfEveryMethodAndAllowed) {
  register_drawing_methods();
  ASSERT_GT(methods().size(), 5u);
  for (const MethodInfo& method : methods()) {
    std::set<std::string> labels;
    for (const apps::Setting& setting : apps::settings_of(method, false)) {
      EXPECT_TRUE(labels.insert(setting.label()).second) << setting.label() << " occurs twice";
      EXPECT_EQ(completed(method.options, setting.options), setting.options) << setting.label();
    }
    EXPECT_TRUE(labels.contains(method.name)) << "no row of the defaults of " << method.name;
    for (const OptionSchema& option : method.options)
      for (const OptionValue& value : apps::steps_of(option))
        EXPECT_TRUE(value == option.usual ||
                    labels.contains(method.name + ", " + option.name + " " + to_text(value)))
            << method.name << " " << option.name << " " << to_text(value);
    EXPECT_LE(apps::settings_of(method, true).size(), std::min(labels.size(), std::size_t{9}));
  }
}

TEST(StudySettings, FewOptionsAreCombined) {
  std::set<std::string> labels;
  for (const apps::Setting& setting : apps::settings_of(method_named("rays"), false))
    labels.insert(setting.label());
  EXPECT_EQ(labels.size(), 12u);  // seven numbers of rays, and five with the filter: not above the default
  EXPECT_FALSE(labels.contains("rays, samples 1024, denoise a-trous"));
  EXPECT_TRUE(labels.contains("rays, samples 16, denoise a-trous"));
}

TEST(StudyMeasure, QuartilesAreOfSortedValues) {
  const apps::Quartiles q = apps::quartiles_of({5.0, 1.0, 4.0, 2.0, 3.0});
  EXPECT_EQ(q.low, 2.0);
  EXPECT_EQ(q.median, 3.0);
  EXPECT_EQ(q.high, 4.0);
  EXPECT_EQ(apps::quartiles_of({}).median, 0.0);
}

class StudyTest : public ProgramTest {
 protected:
  StudyTest() : scene_(write_scene("0.5")) {
    write("t.off", kTetrahedron);
    write("floor.off", "OFF\n4 2 0\n-9 0 -9\n-9 0 9\n9 0 9\n9 0 -9\n3 0 1 2\n3 0 2 3\n");
  }

  /// A tetrahedron over a floor.
  std::string write_scene(const std::string& radius) const {
    std::string text = scene_text("t.off", "", R"("normal":[0,-1,0],"radius":)" + radius);
    return write("s.json", text.insert(text.rfind(']'), R"(,{"mesh":"floor.off"})"));
  }

  Outcome study(std::vector<std::string> more = {}, const std::string& methods = "reference,hard") const {
    std::vector<std::string> all{"study",     scene_,      "--output",   path("out"), "--size",
                                 "64x48",     "--methods", methods,      "--frames",  "2",
                                 "--samples", "64",        "--no-memory"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  Json table() const { return Json::parse(read_text(file("out") / "study.json")); }

  std::string scene_;
};

TEST_F(StudyTest, WritesRowsTablesAndAPage) {
  const Outcome r = study();
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("8 rows measured"), std::string::npos) << r.out;  // 7 of reference, 1 of hard
  const Json json = table();
  EXPECT_EQ(json["cases"].size(), 1u);
  ASSERT_EQ(json["rows"].size(), 8u);
  EXPECT_FALSE(json["about"]["machine"]["processor"].get<std::string>().empty());
  double few = 0.0, many = 0.0, hard = 0.0;
  for (const Json& row : json["rows"]) {
    EXPECT_GT(row["frame_ms"]["median"].get<double>(), 0.0) << row;
    EXPECT_TRUE(row["over_default"].contains("median")) << row;
    EXPECT_TRUE(std::filesystem::exists(file("out") / "pictures" / row["picture"].get<std::string>())) << row;
    const double rmse = row["error"]["penumbra"]["rmse"];
    if (row["label"] == "reference, samples 4") few = rmse;
    if (row["label"] == "reference, samples 1024") many = rmse;
    if (row["method"] == "hard") hard = rmse;
  }
  EXPECT_GT(hard, few);
  EXPECT_GT(few, 4.0 * many);  // 256 times the rays
  EXPECT_GT(few, 0.01);
  const std::string csv = read_text(file("out") / "study.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 9);
  EXPECT_NE(csv.find("\"reference, samples 4\""), std::string::npos) << csv;
  const std::string page = read_text(file("out") / "index.html");
  EXPECT_NE(page.find("\"label\":\"reference, samples 1024\""), std::string::npos);
  for (const char* outside : {"<script src", "<link rel=\"stylesheet\"", "src=\"http", "<!-- data -->"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST_F(StudyTest, TablesSayWhatARowIsOf) {
  std::filesystem::create_directory(file("out"));
  write_text(file("out") / "rows.jsonl",
             "{\"about\":{}}\n"
             R"({"case":{"id":"a","scene":"a","sweep":"","width":64}})"
             "\n"
             R"({"row":{"case":"a","key":"a1","scene":"a","method":"hard"}})"
             "\n"
             R"({"case":{"id":"b","scene":"a","sweep":"light","width":64}})"
             "\n"
             R"({"row":{"case":"b","key":"b1","scene":"a","method":"hard"}})"
             "\n");
  apps::write_tables(apps::StudyRecord(file("out"), Json::object()));
  const std::string csv = read_text(file("out") / "study.csv");
  EXPECT_NE(csv.find("\na,64,,,,,hard,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\na,64,,,light,,hard,"), std::string::npos) << csv;
}

TEST_F(StudyTest, MeasuresOnlyWhatIsMissing) {
  ASSERT_EQ(study({}, "hard").code, 0);
  const Json before = table()["rows"][0];
  const Outcome more = study({}, "hard,none");
  EXPECT_NE(more.out.find("1 row measured"), std::string::npos) << more.out << more.err;
  EXPECT_EQ(table()["rows"][0], before);
  EXPECT_EQ(table()["rows"].size(), 2u);
  EXPECT_NE(study({}, "hard,none").out.find("0 rows measured"), std::string::npos);
}

TEST_F(StudyTest, GoesOnAfterALineThatWasCut) {
  ASSERT_EQ(study({}, "hard,none").code, 0);
  const std::string whole = read_text(file("out") / "rows.jsonl");
  write_text(file("out") / "rows.jsonl", whole.substr(0, whole.size() - 20));
  const Outcome again = study({}, "hard,none");
  EXPECT_NE(again.out.find("1 row measured"), std::string::npos) << again.out << again.err;
  EXPECT_EQ(table()["rows"].size(), 2u);
}

TEST_F(StudyTest, RowsOfAnotherProgramAreNotMixed) {
  ASSERT_EQ(study({"--commit", "a"}, "hard").code, 0);
  const Outcome other = study({"--commit", "b"}, "hard");
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.error_lines(), 1u) << other.err;
  EXPECT_NE(other.err.find("--output"), std::string::npos) << other.err;
}

TEST_F(StudyTest, AnotherSceneOfTheSameNameIsMeasured) {
  ASSERT_EQ(study({}, "hard").code, 0);
  write_scene("0.6");
  EXPECT_NE(study({}, "hard").out.find("1 row measured"), std::string::npos);
  // Its pictures are replaced, and so is what was measured of the other.
  EXPECT_EQ(table()["cases"].size(), 1u);
  EXPECT_EQ(table()["rows"].size(), 1u);
  EXPECT_NE(study({}, "hard").out.find("0 rows measured"), std::string::npos);
}

TEST_F(StudyTest, ErrorsAreTheSameAgain) {
  ASSERT_EQ(study().code, 0);
  const Json first = table()["rows"];
  std::filesystem::remove_all(file("out"));
  ASSERT_EQ(study().code, 0);
  const Json second = table()["rows"];
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) EXPECT_EQ(first[k]["error"], second[k]["error"]);
}

TEST_F(StudyTest, RefusesWhatItCannotMeasure) {
  EXPECT_EQ(run({"study", scene_, "--output", path("out"), "--methods", "nothing"}).code, 2);
  EXPECT_EQ(run({"study", scene_}).code, 2);
  EXPECT_EQ(run({"study", path("missing.json"), "--output", path("out")}).code, 3);
  EXPECT_EQ(run({"study", scene_, scene_, "--output", path("out")}).code, 2);
  EXPECT_EQ(run({"study", path("room_1.json"), path("room-1.json"), "--output", path("out")}).code, 2);
  EXPECT_EQ(run({"study", "-", "--output", path("out")}).code, 2);
}

}  // namespace
}  // namespace penumbra::test
