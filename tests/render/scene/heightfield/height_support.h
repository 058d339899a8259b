// What tests of heightfields share: files of heights, and scenes of them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/io/npy.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::testing {

/// A folder of its own for each test.
class HeightFiles : public ::testing::Test {
 protected:
  HeightFiles() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("penumbra-") + test->test_suite_name() + "-" + test->name());
    std::filesystem::create_directories(folder_);
  }
  ~HeightFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  void write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  /// heights[row][column]
  void write_npy(const std::string& name, const std::vector<std::vector<float>>& heights) const {
    std::ofstream out(path(name), std::ios::binary);
    detail::write_npy_header(out, {heights.size(), heights.front().size()});
    for (const std::vector<float>& row : heights)
      out.write(reinterpret_cast<const char*>(row.data()),
                static_cast<std::streamsize>(row.size() * sizeof(float)));
  }
  /// `object`: what stands between the braces of the one object.
  Scene scene_of(const std::string& object, std::vector<std::string>* warnings = nullptr) const {
    LoadedScene loaded = parse_scene(
        R"({"version": 1, "lights": [{"shape": "distant", "direction": [0, -1, 1]}], "objects": [{)" +
            object + "}]}",
        folder_, "terrain.json");
    if (warnings) *warnings = loaded.warnings;
    return std::move(loaded.scene);
  }
  std::string complaint_of(const std::string& object) const {
    try {
      scene_of(object);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace penumbra::testing
