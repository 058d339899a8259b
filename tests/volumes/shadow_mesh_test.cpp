#include "penumbra/volumes/shadow_mesh.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/shapes.h"
#include "tests/volumes/volume_support.h"

namespace penumbra {
namespace {

using testing::kLight;
using testing::unmatched;

ShadowMesh two_objects() {
  VolumeOptions options;
  std::vector<ShadowMesh> parts;
  for (std::uint32_t object = 0; object < 2; ++object) {
    options.extrude.object = object;
    parts.push_back(
        build_shadow_volumes(make_box({3.0 * object, 5, 0}, Vec3(0.5)), kLight, options).penumbra);
  }
  return merge(parts);
}

TEST(Merge, KeepsTagsAndGuarantee) {
  const ShadowMesh both = two_objects();
  EXPECT_EQ(both.cells, 2u);
  EXPECT_EQ(both.guarantee, Guarantee::kContains);
  EXPECT_EQ(both.tags.front().object, 0u);
  EXPECT_EQ(both.tags.back().object, 1u);
  EXPECT_TRUE(unmatched(both.triangles).empty());
  ShadowMesh exact;
  exact.guarantee = Guarantee::kExact;
  EXPECT_EQ(merge(std::vector{exact, exact}).guarantee, Guarantee::kContained);
  EXPECT_EQ(merge(std::vector{exact}).guarantee, Guarantee::kExact);
}

TEST(WriteShadowMesh, PlyReadsBackWithTheSameDoubles) {
  const ShadowMesh mesh = two_objects();
  const auto path = std::filesystem::temp_directory_path() / "penumbra_shadow_mesh_test.ply";
  write_shadow_mesh(path, mesh);
  const PolygonSoup soup = read_polygon_soup(path);
  EXPECT_EQ(soup.positions, mesh.positions);
  EXPECT_EQ(soup.polygon_count(), mesh.triangles.size());
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const std::size_t record = 1 + 3 * 4 + 1 + 4 + 4,
                    body = mesh.positions.size() * 24 + mesh.triangles.size() * record;
  const std::size_t header = bytes.find("end_header\n") + 11;
  ASSERT_EQ(bytes.size(), header + body);
  EXPECT_EQ(bytes[bytes.size() - 4], 1);  // object of the last triangle
  EXPECT_EQ(bytes[header + mesh.positions.size() * 24 + 13], static_cast<char>(mesh.tags[0].kind));
  std::filesystem::remove(path);
}

TEST(WriteShadowMesh, ObjHasOneGroupPerObjectAndKind) {
  const ShadowMesh mesh = two_objects();
  const auto path = std::filesystem::temp_directory_path() / "penumbra_shadow_mesh_test.obj";
  write_shadow_mesh(path, mesh);
  EXPECT_EQ(read_polygon_soup(path).positions, mesh.positions);
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  for (const char* group :
       {"g object_0_cell\n", "g object_0_far_cap\n", "g object_1_cell\n", "g object_1_far_cap\n"}) {
    EXPECT_NE(text.str().find(group), std::string::npos) << group;
  }
  std::filesystem::remove(path);
  EXPECT_THROW(write_shadow_mesh("x.stl", mesh), UsageError);
  EXPECT_THROW(write_shadow_mesh("/nonexistent/folder/x.ply", mesh), SystemError);
}

}  // namespace
}  // namespace penumbra
