// Where memory is limited a command ends well or says so in one line: no crash, no hang, no other reason.
#include <gtest/gtest.h>

#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

struct Limited {
  const char* name;
  std::vector<std::string> words;
  int from, to, step;  ///< MiB of address space
};

void PrintTo(const Limited& limited, std::ostream* out) {
  *out << limited.name;
}

constexpr const char* kLine = "penumbra: not enough memory; try a smaller --size or mesh\n";

class MemoryTest : public ProgramTest, public testing::WithParamInterface<Limited> {
 protected:
  Outcome run_in(int mebibytes, const std::vector<std::string>& words) const {
    std::vector<std::string> line = {
        "/usr/bin/timeout",
        "60",
        "/bin/sh",
        "-c",
        "ulimit -c 0; ulimit -v " + std::to_string(1024 * mebibytes) + "; exec \"$@\"",
        "sh",
        std::string(PENUMBRA_BIN) + "/penumbra"};
    for (std::string word : words) {
      if (word == "SCENE") word = std::string(PENUMBRA_DATA) + "/scenes/bunny-medium.json";
      if (word == "IMAGE") word = path("image.exr");
      line.push_back(word);
    }
    return run_program(line);
  }
};

TEST_P(MemoryTest, EndsWellOrSaysSo) {
  ASSERT_EQ(run({"render", std::string(PENUMBRA_DATA) + "/scenes/bunny-medium.json", "--method", "none",
                 "--size", "800x600", "--output", path("image.exr")})
                .code,
            0);
  int refused = 0;
  // Below this the system cannot load the program and its libraries.
  int least = GetParam().from;
  while (least < GetParam().to && run_in(least, {"--version"}).code != 0) least += 10;
  ASSERT_LE(least, 200) << "MiB to start at all";
  for (int limit = least; limit <= GetParam().to; limit += GetParam().step) {
    SCOPED_TRACE(std::to_string(limit) + " MiB");
    const Outcome outcome = run_in(limit, GetParam().words);
    if (outcome.code == 0) continue;
    ++refused;
    // Mesa's scanner of shaders ends the program itself, in its own words.
    if (outcome.err.starts_with("out of dynamic memory in yy")) continue;
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with(kLine)) << outcome.err;
    // Mesa's compiler says it in its own words before it gives up.
    const std::string before = outcome.err.substr(0, outcome.err.find(kLine));
    EXPECT_TRUE(before.empty() || before == "LLVM ERROR: out of memory\nAllocation failed\n") << outcome.err;
  }
  EXPECT_GT(refused, 0);
  EXPECT_EQ(run_in(16'384, GetParam().words).code, 0) << "enough is enough";
}

INSTANTIATE_TEST_SUITE_P(
    Commands, MemoryTest,
    testing::Values(
        Limited{"Silhouette", {"render", "SCENE", "--stats", "/dev/null"}, 60, 500, 40},
        Limited{"Rays",
                {"render", "SCENE", "--method", "rays", "--samples", "4", "--stats", "/dev/null"},
                60,
                500,
                40},
        Limited{"DBuffer", {"render", "SCENE", "--method", "dbuffer", "--stats", "/dev/null"}, 60, 1000, 40},
        Limited{"OcclusionTextures",
                {"render", "SCENE", "--method", "occlusion-textures", "--stats", "/dev/null"},
                60,
                1000,
                80},
        Limited{"Compare", {"compare", "IMAGE", "IMAGE"}, 60, 260, 40},
        Limited{"Volumes", {"volumes", "SCENE", "--check", "--report", "/dev/null"}, 60, 240, 20}),
    [](const auto& limited) { return std::string(limited.param.name); });

}  // namespace
}  // namespace penumbra::test
