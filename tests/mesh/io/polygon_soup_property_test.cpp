#include <gtest/gtest.h>

#include <random>

#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

/// Anything may be wrong with the bytes: the result is a mesh or a MeshError of one line, never anything
/// else.
void expect_mesh_or_error(const std::string& bytes, const std::string& name) {
  try {
    const PolygonSoup soup = test::parse(bytes, name);
    ASSERT_GT(soup.polygon_count(), 0u);
    TriangleMesh::build(soup.positions, triangulate(soup).triangles);
  } catch (const MeshError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(message.find(name), 0u) << message;
  }
}

TEST(PolygonSoupProperty, TruncatedAtEveryByte) {
  for (const auto& [name, bytes] : test::tetra_files()) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      SCOPED_TRACE(name + " cut to " + std::to_string(size));
      expect_mesh_or_error(bytes.substr(0, size), name);
    }
  }
}

TEST(PolygonSoupProperty, BinaryFilesTruncatedAnywhereAreErrors) {
  for (const char* name : {"little.ply", "big.ply", "binary.stl"}) {
    for (const auto& [file, bytes] : test::tetra_files()) {
      for (std::size_t size = 0; file == name && size < bytes.size(); ++size) {
        EXPECT_THROW(test::parse(bytes.substr(0, size), name), MeshError) << name << " cut to " << size;
      }
    }
  }
}

class PolygonSoupProperty : public testing::TestWithParam<std::uint64_t> {};

TEST_P(PolygonSoupProperty, DamagedFilesAreMeshesOrErrors) {
  std::mt19937_64 random(GetParam());
  const std::string numbers[] = {"-1",  "4294967295", "4294967294", "99999999999999999999",
                                 "nan", "1e400",      "0x10",       ""};
  for (const auto& [name, original] : test::tetra_files()) {
    for (int round = 0; round < 300; ++round) {
      std::string bytes = original;
      for (auto damages = 1 + random() % 4; damages > 0; --damages) {
        const std::size_t at = random() % bytes.size();
        if (random() % 2 == 0) {
          bytes[at] = static_cast<char>(random());
        } else {
          bytes.replace(at, random() % 4, numbers[random() % std::size(numbers)]);
        }
        bytes += ' ';
      }
      SCOPED_TRACE(name + ", seed " + std::to_string(GetParam()) + ", round " + std::to_string(round));
      expect_mesh_or_error(bytes, name);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PolygonSoupProperty, testing::Range<std::uint64_t>(1, 9));

}  // namespace
}  // namespace penumbra
