// Fields against rays in double, and as files.
#include "penumbra/render/solids/light_field.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle.h"

namespace penumbra {
namespace {

const DiskLight kLight{{0.2, 3.0, 0.1}, {0.0, -1.0, 0.0}, 0.6};

LightField field_of(const std::vector<TriangleMesh>& casters) {
  return light_field(Casters(casters), kLight, {Vec3(-1.5), Vec3(1.5, 3.5, 1.2)}, {41, 50, 33});
}

TEST(LightFields, HoldWhatRaysSee) {
  const std::vector<TriangleMesh> casters{make_torus(Vec3(0.0), 0.7, 0.2, 32, 16)};
  const LightField field = field_of(casters);
  const oracle::Oracle oracle(casters);
  ASSERT_EQ(field.seen.size(), 41u * 50u * 33u);
  std::size_t lit = 0, dark = 0;
  std::mt19937 random(5);
  for (int n = 0; n < 2'000; ++n) {
    const std::size_t i = random() % 41, j = random() % 50, k = random() % 33;
    const Vec3 p = field.origin +
                   field.step * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
    const double seen = field.seen[(k * 50 + j) * 41 + i];
    const double true_seen = is_behind(kLight, p) ? 0.0 : oracle.unoccluded(p, {}, kLight, 1'024, random());
    EXPECT_NEAR(seen, true_seen, 0.01) << i << " " << j << " " << k;
    lit += seen == 1.0 ? 1 : 0;
    dark += seen == 0.0 ? 1 : 0;
  }
  EXPECT_GT(lit, 500u);
  EXPECT_GT(dark, 50u);
}

TEST(LightFields, AreWrittenAsTheyAre) {
  const LightField field = field_of({make_box(Vec3(0.0), Vec3(0.5))});
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  for (const char* name : {"penumbra_field.npy", "penumbra_field.vti"}) {
    write_light_field(folder / name, field);
    std::ifstream in(folder / name, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    const std::string bytes = text.str();
    const std::string values(reinterpret_cast<const char*>(field.seen.data()),
                             field.seen.size() * sizeof(float));
    EXPECT_NE(bytes.find(values), std::string::npos) << name;
    EXPECT_NE(bytes.find(std::string(name).ends_with("npy") ? "(33, 50, 41)" : "0 40 0 49 0 32"),
              std::string::npos);
    std::filesystem::remove(folder / name);
  }
  EXPECT_THROW(write_light_field(folder / "field.txt", field), UsageError);
}

TEST(LightFields, RefuseWhatTheyCannotHold) {
  const Casters casters(std::vector<TriangleMesh>{make_box(Vec3(0.0), Vec3(0.5))});
  EXPECT_THROW(light_field(casters, kLight, {Vec3(0.0), Vec3(1.0)}, {1, 5, 5}), UsageError);
  EXPECT_THROW(light_field(casters, kLight, {Vec3(0.0), Vec3(1.0, 0.0, 1.0)}, {5, 5, 5}), UsageError);
}

}  // namespace
}  // namespace penumbra
