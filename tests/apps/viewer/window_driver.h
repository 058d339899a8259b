// Starts the viewer on a display of its own and drives it as a hand would, with xdotool. Nothing here waits
// for a time to pass: every step polls what --status says until it is so.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "tests/apps/cli/program.h"

namespace penumbra::test {

using Json = nlohmann::json;

/// A child process, ended with this object.
class Child {
 public:
  Child() = default;
  explicit Child(std::vector<std::string> arguments, const std::string& display = "",
                 const std::string& log = "") {
    std::vector<char*> argv;
    for (std::string& each : arguments) argv.push_back(each.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    if (!display.empty()) setenv("DISPLAY", display.c_str(), 1);
    if (!log.empty() && !std::freopen(log.c_str(), "w", stderr)) _exit(126);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  Child(const Child&) = delete;
  Child& operator=(Child&& other) noexcept {
    std::swap(pid_, other.pid_);
    return *this;
  }
  ~Child() {
    if (pid_ <= 0) return;
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
  }
  /// The exit code; -1 where a signal ended it.
  int wait() {
    int status = 0;
    waitpid(std::exchange(pid_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  bool running() const { return pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == 0; }

 private:
  pid_t pid_ = 0;
};

class WindowTest : public ProgramTest {
 protected:
  /// Xvfb chooses a free display and says which.
  void SetUp() override {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    server_ = Child(
        {"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "1400x900x24", "-nolisten", "tcp"},
        "", "/dev/null");
    close(ends[1]);
    std::string number;
    for (char c; read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    ASSERT_FALSE(number.empty()) << "Xvfb does not start: install the Debian package xvfb";
    display_ = ":" + number;
  }

  static std::string viewer() { return std::string(PENUMBRA_BIN) + "/penumbra-viewer"; }

  /// Opens the window and waits for the final picture.
  void open(std::vector<std::string> arguments) {
    start_with_status(std::move(arguments));
    until("the first picture", [](const Json& s) { return s["settled"] == true; });
    ASSERT_TRUE(focuses()) << "the window is not there";
  }
  /// Opens the window without a file, in the test's folder.
  void open_empty() {
    const std::filesystem::path here = std::filesystem::current_path();
    std::filesystem::current_path(file(""));
    start_with_status({"--size", "700x500"});
    std::filesystem::current_path(here);
    until("the window", [](const Json& s) { return s.contains("empty"); });
    ASSERT_TRUE(focuses()) << "the window is not there";
  }

  void start_with_status(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), viewer());
    for (const std::string& each :
         {std::string("--status"), path("status.json"), std::string("--output"), file("").string()})
      arguments.push_back(each);
    program_ = {};  // what an earlier one wrote is not what this one shows
    std::filesystem::remove(file("status.json"));
    program_ = Child(arguments, display_, path("errors"));
  }

  /// X refuses the focus to a window that the server has not shown yet.
  bool focuses() const {
    for (int i = 0; i < 100; ++i) {
      if (tool("search --sync --name Penumbra windowfocus --sync") == 0) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  int wait_for_end() { return program_.wait(); }
  Child start(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), viewer());
    return Child(std::move(arguments), display_, (file("errors")).string());
  }

  Json status() const {
    const Json parsed = Json::parse(read_text(file("status.json")), nullptr, false);
    return parsed.is_discarded() ? Json::object({{"settled", false}}) : parsed;
  }

  /// Polls for half a minute; the loaded machine decides how soon. Throws, which ends the test.
  Json until(const std::string& what, const std::function<bool(const Json&)>& so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    Json now;
    while (std::chrono::steady_clock::now() < end) {
      now = status();
      if (so(now)) return now;
      if (!program_.running()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    throw std::runtime_error("waited in vain for " + what + "; last: " + now.dump() +
                             read_text(file("errors")));
  }
  Json settled(const std::string& what, const std::function<bool(const Json&)>& so) {
    return until(what, [&](const Json& s) { return s["settled"] == true && s["holding"] == false && so(s); });
  }

  int tool(const std::string& arguments) const {
    const std::string command = "DISPLAY=" + display_ + " xdotool " + arguments + " >/dev/null 2>&1";
    return std::system(command.c_str());
  }
  /// What Ctrl+V would paste elsewhere.
  std::string clipboard() const {
    const std::string to = path("clipboard");
    const std::string command = "DISPLAY=" + display_ + " xclip -selection clipboard -o >'" + to + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << "install xclip";
    return read_text(to);
  }
  /// Minimising is the window manager's. Not while the window opens: GLFW 3.3 can then wait for ever.
  void start_window_manager() { manager_ = Child({"openbox"}, display_, path("openbox")); }
  void key(const std::string& name) const { EXPECT_EQ(tool("key " + name), 0) << "install xdotool"; }

  /// Presses at a place, moves by so much, and lets go once `done` holds.
  void drag(const Json& from, int x, int y, const std::string& what,
            const std::function<bool(const Json&)>& done, int button = 1) {
    const auto at = [](double value) { return std::to_string(static_cast<int>(value + 0.5)); };
    tool("mousemove " + at(from[0]) + " " + at(from[1]));
    tool("mousedown " + std::to_string(button));
    until("the drag's start", [](const Json& s) { return s["holding"] == true; });
    tool("mousemove_relative -- " + std::to_string(x) + " " + std::to_string(y));
    until(what, done);
    tool("mouseup " + std::to_string(button));
    settled("the drag's end", [](const Json&) { return true; });
  }

 private:
  Child server_, manager_, program_;
  std::string display_;
};

}  // namespace penumbra::test
