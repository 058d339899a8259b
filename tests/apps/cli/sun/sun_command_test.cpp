// penumbra sun: times, receivers, files and complaints.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/cli/sun/civil_time.h"
#include "apps/cli/sun/receiver_set.h"
#include "apps/cli/sun/sun_arguments.h"
#include "mesh/io/npy.h"
#include "penumbra/mesh/error.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using namespace penumbra::apps;

TEST(CivilTime, IsReadAndWritten) {
  EXPECT_EQ(parse_time("--from", "1970-01-02").unix_time, 86400.0);
  EXPECT_EQ(parse_time("--from", "2003-10-17T12:30:30-07:00").unix_time, 1066419030.0);
  EXPECT_EQ(parse_time("--from", "2003-10-17T19:30:30.5Z").unix_time, 1066419030.5);
  for (const char* text :
       {"2024-02-29T23:59:59+05:30", "1969-12-31T00:00:00-03:00", "2026-06-21T03:00:00Z"}) {
    const CivilTime time = parse_time("--from", text);
    EXPECT_EQ(time_text(time.unix_time, time.offset), text);
  }
  EXPECT_EQ(time_text(1066419030.26, -7 * 3600, 1), "2003-10-17T12:30:30.3-07:00");
  for (const char* text : {"", "now", "2026-02-29", "2026-13-01", "2026-01-01T25:00", "2026-01-01T24:01",
                           "2026-01-01T10", "26-01-01", "2026-01-01T10:00+02:75", "2026-01-01T10:00+99:00"})
    EXPECT_THROW(parse_time("--from", text), UsageError) << text;
  EXPECT_EQ(parse_duration("--step", "1.5h"), 5400.0);
  EXPECT_EQ(parse_duration("--step", "15min"), 900.0);
  for (const char* text : {"0s", "1", "h", "-1h", "1week"})
    EXPECT_THROW(parse_duration("--step", text), UsageError) << text;
}

TEST(SunArgumentsTest, AxesAreWordsOrNumbers) {
  EXPECT_EQ(parse_axis("--up", "z"), Vec3(0, 0, 1));
  EXPECT_EQ(parse_axis("--up", "-x"), Vec3(-1, 0, 0));
  EXPECT_EQ(parse_axis("--up", "0,.5,-2"), Vec3(0, .5, -2));
  for (const char* text : {"", "up", "1,2", "1,2,3,4", "nan,0,0"})
    EXPECT_THROW(parse_axis("--up", text), UsageError) << text;
}

class SunCommandTest : public ProgramTest {
 protected:
  SunCommandTest() {
    write("t.off", kTetrahedron);
    write("scene.json", R"({"version":1,"lights":[{"shape":"distant","direction":[0,-1,0]}],
"camera":{"eye":[3,3,4],"target":[0,0.4,0]},"objects":[{"mesh":"t.off"}]})");
    write("p.csv", "x, y, z, nx, ny, nz\n0.3,0,-0.5,0,2,0\n5;0;5;0;1;0\n\n# end\n");
  }
  std::vector<std::string> sun(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {
        "sun",   path("scene.json"), "--latitude",        "50",   "--longitude",
        "-10.5", "--from",           "2026-03-20T00:00Z", "--to", "2026-03-21T00:00Z"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(SunCommandTest, WritesRowsHoursContactsAndAReport) {
  const Outcome outcome =
      run(sun({"--points", path("p.csv"), "--step", "30min", "--output", path("seen.csv"), "--hours",
               path("hours.csv"), "--contacts", path("contacts.csv"), "--report", path("report.json")}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 receivers, 49 times"), std::string::npos) << outcome.out;
  std::istringstream seen(read_text(path("seen.csv")));
  std::string line;
  std::getline(seen, line);
  EXPECT_EQ(line, "time,azimuth,elevation,0,1");
  std::vector<std::string> lines;
  while (std::getline(seen, line)) lines.push_back(line);
  ASSERT_EQ(lines.size(), 49u);
  EXPECT_TRUE(lines[0].starts_with("2026-03-20T00:00:00Z,")) << lines[0];
  EXPECT_TRUE(lines[0].ends_with(",0,0")) << lines[0];
  EXPECT_TRUE(lines[20].ends_with(",1")) << lines[20];
  const auto report = nlohmann::json::parse(read_text(path("report.json")));
  EXPECT_EQ(report["steps"], 49);
  EXPECT_GT(report["nights"], 20);
  EXPECT_GE(report["contacts"], 8);                  // two receivers, morning and evening
  EXPECT_NEAR(report["hours"]["most"], 12.0, 0.35);  // of an equinox
  EXPECT_LT(report["hours"]["least"], report["hours"]["most"]);
  const std::string contacts = read_text(path("contacts.csv"));
  EXPECT_TRUE(contacts.starts_with("receiver,time,event\n0,2026-03-20T06:")) << contacts;
  EXPECT_NE(contacts.find("1,2026-03-20T06:"), std::string::npos);
  EXPECT_TRUE(read_text(path("hours.csv")).starts_with("x,y,z,hours\n"));
}

TEST_F(SunCommandTest, ArraysAreThoseOfNumPy) {
  for (const char* at : {"faces", "vertices"}) {
    const Outcome outcome = run(sun({"--object", "t.off", "--at", at, "--output", path("seen.npy")}));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const detail::NpyRows rows = detail::read_npy_rows(path("seen.npy"));
    EXPECT_EQ(rows.rows, 25u);
    EXPECT_EQ(rows.columns, 4u);
    EXPECT_EQ(*std::ranges::max_element(rows.values), 1.0);
  }
}

TEST_F(SunCommandTest, PointsAreReadFromThreeFormats) {
  const ReceiverSet csv = read_receivers(path("p.csv"));
  ASSERT_EQ(csv.size(), 2u);
  EXPECT_EQ(csv.normals[0], Vec3(0, 1, 0));
  EXPECT_EQ(csv.points[1], Vec3(5, 0, 5));
  write("p.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nend_header\n1 2 3 0 0 4\n");
  EXPECT_EQ(read_receivers(path("p.ply")).points[0], Vec3(1, 2, 3));
  EXPECT_EQ(read_receivers(path("p.ply")).normals.at(0), Vec3(0, 0, 1));
  std::ostringstream npy;
  detail::write_npy_header(npy, {2, 3});
  const float values[] = {1, 2, 3, 4, 5, 6};
  npy.write(reinterpret_cast<const char*>(values), sizeof values);
  write("p.npy", npy.str());
  EXPECT_EQ(read_receivers(path("p.npy")).points.at(1), Vec3(4, 5, 6));
  write("short.npy", npy.str().substr(0, npy.str().size() - 1));
  EXPECT_THROW(read_receivers(path("short.npy")), MeshError);
}

TEST_F(SunCommandTest, ComplaintsSayWhatWhereAndWhatToDo) {
  write("bad.csv", "x,y,z\n1,2,3\n1,2\n");
  write("word.csv", "1,2,3\n1,two,3\n");
  write("first.csv", "1,2,O\n1,2,3\n");
  write("empty.csv", "1,2,,3\n");
  write("flat.csv", "1,2,3,0,0,0\n");
  struct Case {
    std::vector<std::string> words;
    int code;
    std::string says;
  };
  const std::string out = path("out.csv");
  for (const Case& c : std::vector<Case>{
           {sun({"--output", out}), 2, "--points FILE"},
           {sun({"--points", path("p.csv")}), 2, "nothing to do"},
           {sun({"--points", path("none.csv"), "--output", out}), 3, "no such file"},
           {sun({"--points", path("bad.csv"), "--output", out}), 3, "line 3"},
           {sun({"--points", path("word.csv"), "--output", out}), 3, "line 2"},
           {sun({"--points", path("first.csv"), "--output", out}), 3, "line 1"},
           {sun({"--points", path("empty.csv"), "--output", out}), 3, "line 1"},
           {sun({"--points", path("flat.csv"), "--output", out}), 3, "normal of length 0"},
           {sun({"--points", path("p.csv"), "--output", path("out.xls")}), 2, ".npy"},
           {sun({"--points", path("p.csv"), "--step", "5", "--output", out}), 2, "15min"},
           {sun({"--points", path("p.csv"), "--step", "0.001s", "--output", out}), 2, "longer step"},
           {sun({"--object", "u.off", "--output", out}), 2, "t.off"},
           {sun({"--points", path("p.csv"), "--up", "y", "--north=-y", "--output", out}), 2, "parallel"},
           {sun({"--points", path("p.csv"), "--method", "reference", "--contacts", out}), 2, "noise"},
           {sun({"--points", path("p.csv"), "--method", "dbuffer", "--output", out}), 2, "dbuffer"}}) {
    const Outcome outcome = run(c.words);
    EXPECT_EQ(outcome.code, c.code) << outcome.err;
    EXPECT_NE(outcome.err.find(c.says), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

}  // namespace
}  // namespace penumbra::test
