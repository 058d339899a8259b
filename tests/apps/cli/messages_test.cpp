// What is said while something takes long, and the line on a terminal.
#include "apps/common/messages.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

namespace penumbra::apps {
namespace {

TEST(ProgressText, HasAnEstimateWhereThereIsOne) {
  EXPECT_EQ(progress_text("rendering", 0.25, 4.0), "rendering  25%, 12 s left");
  EXPECT_EQ(progress_text("rendering", 0.5, 1.0), "rendering  50%, 1 s left");
  EXPECT_EQ(progress_text("rendering", 0.01, 10.0), "rendering   1%, 17 min left");
}

TEST(ProgressText, HasNoneWhereItWouldBeAGuess) {
  EXPECT_EQ(progress_text("a", 0.0, 9.0), "a   0%");
  EXPECT_EQ(progress_text("a", 0.005, 9.0), "a   0%");
  EXPECT_EQ(progress_text("a", 0.5, 0.9), "a  50%");
  EXPECT_EQ(progress_text("a", 1.0, 9.0), "a 100%");
}

/// What the program writes to a terminal, its standard error, until it ends.
std::string on_a_terminal(const std::vector<std::string>& words) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    std::vector<char*> argv;
    std::vector<std::string> copies = words;
    for (std::string& word : copies) argv.push_back(word.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  std::string said;
  std::array<char, 4096> block;
  for (ssize_t n = 0; (n = read(terminal, block.data(), block.size())) > 0;)
    said.append(block.data(), static_cast<std::size_t>(n));
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << said;
  return said;
}

TEST(ProgressLine, ShowsAnEstimateOnATerminal) {
  // Some three seconds of rays.
  const std::string scene = std::string(PENUMBRA_DATA) + "/scenes/cube-small.json";
  const std::string said =
      on_a_terminal({std::string(PENUMBRA_BIN) + "/penumbra", "render", scene, "--method", "reference",
                     "--samples", "24576", "--size", "160x120", "--threads", "1", "--stats", "/dev/null"});
  EXPECT_NE(said.find("\rrendering "), std::string::npos) << said;
  EXPECT_NE(said.find(" s left"), std::string::npos) << said;
  EXPECT_TRUE(said.ends_with("\r\033[K")) << said;
}

// 21 MB, most of them a comment.
TEST(ProgressLine, SaysWhatIsReadWhereThatIsMuch) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("penumbra-test-" + std::to_string(getpid()) + "-much.off");
  const std::string mesh = "4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n";
  std::ofstream(file) << "OFF\n#" << std::string(21'000'000, 'x') << "\n" << mesh;
  const std::string said =
      on_a_terminal({std::string(PENUMBRA_BIN) + "/penumbra", "classify", file.string()});
  std::filesystem::remove(file);
  EXPECT_EQ(said.find("\rreading " + file.string()), 0u) << said;
  EXPECT_NE(said.find("\r\033[K"), std::string::npos) << "gone when it is read: " << said;
}

}  // namespace
}  // namespace penumbra::apps
