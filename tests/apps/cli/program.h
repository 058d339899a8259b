// Runs the built program `penumbra` as a user would, and folders to run it in.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace penumbra::test {

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct Outcome {
  int code = -1;  ///< exit code; -1 where a signal ended the program
  std::string out, err;
  std::size_t error_lines() const {
    return static_cast<std::size_t>(std::count(err.begin(), err.end(), '\n'));
  }
};

/// A fresh folder for each test, removed with all it holds.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "penumbra-test-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    logs_ = folder_.string() + "-logs";
    std::filesystem::create_directory(logs_);
  }
  ~ProgramTest() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::remove_all(logs_);
  }

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  std::string path(const std::string& name) const { return file(name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    write_text(file(name), text);
    return path(name);
  }
  /// Names in the folder, sorted: to see that nothing half-written remains.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  /// `input`: what the program reads from standard input.
  Outcome run(std::vector<std::string> arguments, const std::string& input = "/dev/null") const {
    arguments.insert(arguments.begin(), std::string(PENUMBRA_BIN) + "/penumbra");
    return run_program(std::move(arguments), input);
  }
  Outcome run_program(std::vector<std::string> arguments, const std::string& input = "/dev/null") const {
    std::vector<char*> argv;
    for (std::string& each : arguments) argv.push_back(each.data());
    argv.push_back(nullptr);
    const std::string out = logs_ / "out", err = logs_ / "err";
    const pid_t child = fork();
    if (child == 0) {
      if (!std::freopen(input.c_str(), "r", stdin) || !std::freopen(out.c_str(), "w", stdout) ||
          !std::freopen(err.c_str(), "w", stderr))
        _exit(126);
      execv(argv[0], argv.data());
      _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {
        .code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = read_text(out), .err = read_text(err)};
  }

 private:
  std::filesystem::path folder_, logs_;
};

/// A tetrahedron above y = 0.
inline constexpr const char* kTetrahedron = R"(OFF
4 4 0
0 0.1 0
1 0.1 0
0 0.1 1
0.2 1 0.2
3 0 1 2
3 0 3 1
3 1 3 2
3 2 3 0
)";

/// A scene with one object, a mesh file beside it; `object` is further JSON of the object, such as
/// `,"scale":2`.
inline std::string scene_text(const std::string& mesh, const std::string& object = "",
                              const std::string& light = R"("normal":[0,-1,0],"radius":0.5)") {
  return R"({"version":1,"lights":[{"shape":"disk","center":[0,4,0],)" + light + R"(}],
"camera":{"eye":[3,3,4],"target":[0,0.4,0]},"objects":[{"mesh":")" +
         mesh + "\"" + object + "}]}";
}

}  // namespace penumbra::test
