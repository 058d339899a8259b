// Exports in the background, without a window.
#include "apps/viewer/work/exports.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/apps/cli/program.h"
#include "tests/apps/viewer/scenes.h"

namespace penumbra::viewer {
namespace {

void wake_nobody() {}

class ExportsTest : public penumbra::test::ProgramTest {
 protected:
  /// What the export says at its end; at most half a minute.
  std::string end_of(Exports& exports) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
      if (const std::string news = exports.news(); !news.empty()) return news;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return "it does not end";
  }
};

TEST_F(ExportsTest, NothingThatIsThereIsWrittenOver) {
  Exports exports(wake_nobody);
  const State state = document_of("scenes/cube-medium.json").state();
  for (const char* stem : {"cube-medium-001", "cube-medium-002"}) {
    exports.start(kSolidExport, file(""), state);
    EXPECT_TRUE(exports.busy());
    const std::string said = end_of(exports);
    EXPECT_NE(said.find(std::string(stem) + "-{umbra,penumbra}.ply: the umbra has"), std::string::npos)
        << said;
    EXPECT_TRUE(std::filesystem::exists(file(std::string(stem) + "-umbra.ply")));
    EXPECT_TRUE(std::filesystem::exists(file(std::string(stem) + "-penumbra.ply")));
    EXPECT_FALSE(exports.busy());
  }
}

TEST_F(ExportsTest, MoreDetailOfThePanelIsMoreOfTheSolid) {
  Exports exports(wake_nobody);
  State state = document_of("scenes/cube-medium.json").state();
  std::vector<std::uintmax_t> bytes;
  for (const double detail : {0.05, 0.01, kFinest}) {
    state.overlays.detail = detail;
    exports.start(kSolidExport, file(""), state);
    const std::string said = end_of(exports);
    ASSERT_TRUE(said.starts_with("saved")) << said;
    bytes.push_back(std::filesystem::file_size(
        file("cube-medium-00" + std::to_string(bytes.size() + 1) + "-penumbra.ply")));
  }
  EXPECT_EQ(bytes[0], bytes[1]) << "no coarser than usual";
  EXPECT_GT(bytes[2], bytes[1] * 5 / 4);
}

// The usual detail of a torus takes many seconds.
TEST_F(ExportsTest, TellsHowFarItIsAndIsGivenUpWithNothingWritten) {
  Exports exports(wake_nobody);
  const State state = document_of("scenes/torus-medium.json").state();
  EXPECT_EQ(exports.activity(), "");
  exports.start(kSolidExport, file(""), state);
  EXPECT_NE(exports.start(kCellExport, file(""), state).find("still running"), std::string::npos);
  while (exports.activity() == "exporting umbra and penumbra: 0%" && exports.busy())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(exports.activity().starts_with("exporting umbra and penumbra: ")) << exports.activity();
  exports.cancel();
  EXPECT_EQ(end_of(exports), "given up: umbra and penumbra");
  EXPECT_TRUE(files().empty());
}

TEST_F(ExportsTest, EveryExportIsGivenUp) {
  const State state = document_of("scenes/torus-medium.json").state();
  for (const Export* each : {&kSolidExport, &kCellExport, &kSequenceExport}) {
    const auto nowhere = [](double) { return false; };
    EXPECT_THROW(each->run(file(""), state, nowhere), Cancelled) << each->name;
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(ExportsTest, TroubleIsWhatItSays) {
  Exports exports(wake_nobody);
  const State state = document_of("scenes/cube-medium.json").state();
  exports.start(kSolidExport, file("no-such-folder"), state);
  EXPECT_NE(end_of(exports).find("no-such-folder"), std::string::npos);
}

}  // namespace
}  // namespace penumbra::viewer
