// Files as they come from elsewhere: what is read, what is refused by its name, what is said to be ignored.
#include <gtest/gtest.h>

#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using test::parse;

std::string error_in(const std::string& text, const std::string& name) {
  return test::mesh_error_of([&] { parse(text, name); });
}

TEST(OddFiles, VerticesThatNoFaceUsesNeedNotBeFinite) {
  const std::string faces = "v 0 1 0\nf 1 2 4\n";
  const PolygonSoup soup = parse("v 0 0 0\nv 1 0 0\nv nan -1.#IND 1e999\n" + faces, "a.obj");
  EXPECT_EQ(soup.positions[2], Vec3(0.0));
  EXPECT_EQ(soup.positions.size(), 4u);
  EXPECT_NE(error_in("v 0 0 0\nv 1 0 0\nv 1.#IN 0 0\n" + faces, "a.obj").find("'1.#IN'"), std::string::npos);
}

TEST(OddFiles, NamesWhatHasToBeUnpackedOrConverted) {
  const auto expect = [](const std::string& bytes, const std::string& name, const std::string& part) {
    const std::string message = error_in(bytes, name);
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  std::string wide;
  for (const char c : test::tetra_obj()) wide += std::string{c, '\0'};
  expect(wide, "a.obj", "UTF-16");
  expect("\xFF\xFE" + wide, "a.obj", "UTF-16");
  expect("\xFE\xFF" + wide.substr(1), "a.ply", "UTF-16");
  expect("\x1F\x8B\x08 and so on", "a.ply", "gzip");
  expect("\x1F\x8B\x08 and so on", "a.obj.gz", "gzip");
  expect("PK\x03\x04 and so on", "a.obj", "zip");
}

TEST(OddFiles, CountsOfOffMayStandOnLinesOfTheirOwn) {
  const std::string rest = "0.5 1 2\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* counts : {"3 1 0\n", "3 1\n", "3\n1\n0\n", "3 1\n0\n", "3\n1 0\n", "3 1 # two\n"}) {
    const PolygonSoup soup = parse(std::string("OFF\n") + counts + rest, "a.off");
    EXPECT_EQ(soup.positions[0], Vec3(0.5, 1, 2)) << counts;
    EXPECT_EQ(soup.polygon_count(), 1u) << counts;
  }
}

TEST(OddFiles, NamesWhatIsIgnored) {
  const auto ignored = [](const std::string& text, const std::string& name) {
    return parse(text, name).ignored;
  };
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  using Names = std::vector<std::string>;
  EXPECT_EQ(ignored(corners + "f 1 2 3\n", "a.obj"), Names());
  EXPECT_EQ(ignored(corners + "vn 0 0 1\nvt 0 0\nvn 0 0 1\nl 1 2\nf 1 2 3\n", "a.obj"),
            (Names{"texture coordinates", "lines"}));
  EXPECT_EQ(ignored("STCNOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off"),
            (Names{"texture coordinates", "colors"}));
  EXPECT_EQ(ignored(test::tetra_ply_binary(false), "a.ply"), Names{"colors"});
}

TEST(Normals, OfCornersInObj) {
  const std::string corners =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 2\nvn 0 1 0\nvn nan 0 0\nvn 0 0 0\n";
  const PolygonSoup soup =
      parse(corners + "f 1 2 3\nf 1//1 2/7/2 3//-3 4\nf 2//3 4//4 3//9\nf 1/1/x 2// 3/2\n", "a.obj");
  constexpr std::uint32_t kNone = PolygonSoup::kNoNormal;
  EXPECT_EQ(soup.corner_normals, (std::vector<std::uint32_t>{kNone, kNone, kNone, 0, 1, 1, kNone, kNone,
                                                             kNone, kNone, kNone, kNone, kNone}));
  EXPECT_EQ(soup.normals[0], Vec3(0, 0, 2));
  const Triangulation triangulation = triangulate(soup);
  ASSERT_EQ(triangulation.corners.size(), triangulation.triangles.size());
  for (std::size_t t = 0; t < triangulation.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(soup.corners[triangulation.corners[t][k]], triangulation.triangles[t][k]);
  EXPECT_TRUE(parse(corners + "f 1 2 3\n", "a.obj").normals.empty()) << "no corner uses them";
  EXPECT_TRUE(triangulate(parse(corners + "f 1 2 3\n", "a.obj")).corners.empty());
}

TEST(Normals, OfVerticesInOffAndPly) {
  const PolygonSoup off =
      parse("NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 1 0 0\n0 1 0\n1 1 0 0 1 0\n3 0 1 2\n3 1 3 2\n", "a.off");
  constexpr std::uint32_t kNone = PolygonSoup::kNoNormal;
  EXPECT_EQ(off.corner_normals, (std::vector<std::uint32_t>{0, 1, kNone, 1, 3, kNone}));
  EXPECT_EQ(off.normals[1], Vec3(1, 0, 0));
  const PolygonSoup ply = parse(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float x\nproperty float "
      "ny\nproperty float "
      "nz\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int "
      "vertex_indices\nend_header\n"
      "0 0 0 1 0 0\n-1.#IND 1 0 1 0 0\n0 0 1 0 2 3\n3 0 1 2\n",
      "a.ply");
  EXPECT_EQ(ply.positions[2], Vec3(0, 2, 3));
  EXPECT_EQ(ply.normals[2], Vec3(0, 1, 0));
  EXPECT_EQ(ply.corner_normals, (std::vector<std::uint32_t>{0, kNone, 2}));
}

TEST(OddFiles, StripsOfTriangles) {
  const auto ply = [](const std::string& faces, const std::string& strips) {
    return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n" +
           faces + strips + "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";
  };
  const std::string strips = "element tristrips 2\nproperty int id\nproperty list int int vertex_indices\n";
  const PolygonSoup soup = parse(ply("", strips) + "7 4 0 1 2 3\n8 6 0 1 -1 2 3 4\n", "a.ply");
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4}));
  EXPECT_EQ(soup.polygon_count(), 3u);
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  EXPECT_EQ(parse(ply(faces, strips) + "3 0 1 2\n7 3 2 1 3\n8 0\n", "a.ply").polygon_count(), 2u)
      << "faces beside strips";
  EXPECT_NE(error_in(ply("", strips) + "7 4 0 1 2 9\n8 0\n", "a.ply").find("vertex 9"), std::string::npos);
  EXPECT_NE(error_in(ply("", strips) + "7 4 0 1 2 -3\n8 0\n", "a.ply").find("cannot exist"),
            std::string::npos);
  EXPECT_NE(
      error_in(ply("", "element range_grid 1\nproperty list int int vertex_indices\n") + "1 0\n", "a.ply")
          .find("range_grid"),
      std::string::npos);
}

TEST(OddFiles, BinaryThatSaysSolidAndHasBytesToSpare) {
  std::string stl = test::tetra_stl_binary();
  stl.replace(0, 6, "solid ");
  EXPECT_EQ(parse(stl + "spare", "a.stl").polygon_count(), 4u);
  EXPECT_NE(error_in(stl.substr(0, 100), "a.stl").find("line"), std::string::npos)
      << "no room for its facets";
  EXPECT_EQ(parse("solid caf\xC3\xA9" + test::tetra_stl_ascii().substr(11), "a.stl").polygon_count(), 4u);
}

}  // namespace
}  // namespace penumbra
