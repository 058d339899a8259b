// What is said while something takes long, and the line on a terminal.
#include "apps/common/messages.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

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

}  // namespace
}  // namespace penumbra::apps
