#include "penumbra/mesh/io/polygon_soup.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>

#include "penumbra/mesh/shapes.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using test::mesh_error_of;
using test::parse;
using test::TemporaryFolder;
using test::write_text;

std::string error_in(const std::string& text, const std::string& name) {
  return mesh_error_of([&] { parse(text, name); });
}

TEST(ReadMesh, EveryFormatGivesTheTetrahedron) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : test::tetra_files()) {
    SCOPED_TRACE(name);
    write_text(folder / name, bytes);
    const TriangleMesh mesh = read_mesh(folder / name);
    test::expect_sound(mesh);
    EXPECT_TRUE(mesh.is_closed());
    ASSERT_EQ(mesh.positions().size(), 4u);
    EXPECT_DOUBLE_EQ(mesh.components()[0].signed_volume, 1.0 / 6.0);
    EXPECT_EQ(mesh.report().flipped_components, 0u);
  }
}

TEST(ReadMesh, FormatIsToldByContentBeforeExtension) {
  EXPECT_EQ(parse(test::tetra_ply_ascii(), "misnamed.obj").polygon_count(), 4u);
  EXPECT_EQ(parse(test::tetra_off(), "noextension").polygon_count(), 4u);
  EXPECT_EQ(parse(test::tetra_stl_ascii(), "noextension").polygon_count(), 4u);
  EXPECT_EQ(parse(test::tetra_stl_binary(), "noextension").polygon_count(), 4u);
  EXPECT_EQ(parse(test::tetra_obj(), "UPPER.OBJ").polygon_count(), 4u);
  EXPECT_NE(error_in("hello world", "a.txt").find("no known mesh format"), std::string::npos);
  EXPECT_NE(error_in("hello world", "a.ply").find("does not begin with 'ply'"), std::string::npos);
}

TEST(ReadMesh, LineEndsDoNotMatter) {
  for (const std::string& end : {std::string("\r\n"), std::string("\r")}) {
    for (const auto& [name, bytes] : test::tetra_files()) {
      if (bytes.find('\0') != std::string::npos) {
        continue;  // binary
      }
      std::string changed = name.ends_with(".obj") ? "\xEF\xBB\xBF" : "";
      for (const char c : bytes) {
        changed += c == '\n' ? end : std::string(1, c);
      }
      EXPECT_EQ(parse(changed, name).polygon_count(), 4u) << name;
    }
  }
}

TEST(ReadMesh, RefusesWhatIsNoMeshFile) {
  const TemporaryFolder folder;
  const auto error_of = [](const std::filesystem::path& path) {
    return mesh_error_of([&] { read_polygon_soup(path); });
  };
  EXPECT_NE(error_of(folder / "none.ply").find("no such file"), std::string::npos);
  EXPECT_NE(error_of(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(error_of("/dev/null").find("not a regular file"), std::string::npos);
  EXPECT_NE(error_of(folder / "bad\nname.ply").find("bad?name.ply"), std::string::npos);
  const std::filesystem::path pipe = folder / "pipe.ply";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(error_of(pipe).find("not a regular file"), std::string::npos);
  write_text(folder / "empty.ply", "");
  EXPECT_NE(error_of(folder / "empty.ply").find("is empty"), std::string::npos);
  write_text(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n");
  EXPECT_NE(mesh_error_of([&] { read_mesh(folder / "flat.obj"); }).find("distinct corners"),
            std::string::npos);
}

TEST(ReadObj, CornersInEveryForm) {
  const PolygonSoup soup = parse(
      "o thing\nvt 0 0\nvn 0 0 1\nv 0 0 0 1.0\nv +1 0 0 0.5 0.5 0.5\nv 1. 1e0 0 # comment\nv .0 1 -0.0\n"
      "usemtl red\nf 1/1 2/1 3/1 4/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\nf -4 -3 \\\n -2\nl 1 2\ns off\n"
      "v 2 2 2\nf -1 1 2\ng \\\nf 9 9 9\n",
      "a.obj");
  EXPECT_EQ(soup.positions.size(), 5u);
  EXPECT_EQ(soup.polygon_count(), 5u) << "the last f continues a g line";
  EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1, 2, 0, 1, 2, 0, 1, 2, 4, 0, 1}));
  EXPECT_EQ(parse("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "a.obj").polygon_count(), 1u)
      << "faces may come first";
}

TEST(ReadObj, ErrorsNameTheLine) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_NE(error_in("v 0 0\n", "a.obj").find("a.obj: line 1: vertex 0 needs three numbers"),
            std::string::npos);
  EXPECT_NE(error_in("v 0 zero 0\n", "a.obj").find("'zero'"), std::string::npos);
  EXPECT_NE(error_in(vertices + "f 1 2 0\n", "a.obj").find("line 4"), std::string::npos);
  EXPECT_NE(error_in(vertices + "f 1 2 -4\n", "a.obj").find("line 4"), std::string::npos);
  EXPECT_NE(error_in(vertices + "f 1 2 x\n", "a.obj").find("'x'"), std::string::npos);
  EXPECT_NE(error_in(vertices + "f 1 2 4\n", "a.obj").find("face 0 uses vertex 3"), std::string::npos);
  error_in(vertices + "f 1 2 99999999999\n", "a.obj");
  error_in(vertices + "f 1 2 99999999999999999999999\n", "a.obj");
  EXPECT_NE(error_in(vertices, "a.obj").find("no faces"), std::string::npos);
}

TEST(ReadMesh, CoordinatesMustBeFinite) {
  for (const char* bad :
       {"nan", "inf", "-inf", "1e999", "-1e99999999999999999999", "-1.#IND", "1.#QNAN0", "1.#INF00"}) {
    const std::string message =
        error_in(std::string("v 0 0 0\nv 1 ") + bad + " 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
    EXPECT_NE(message.find("line 2: vertex 1 has a coordinate that is not finite"), std::string::npos)
        << message;
  }
  const PolygonSoup soup =
      parse("v 1e-999 -1e-999999999999999999999 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(soup.positions[0], Vec3(0, 0, 0)) << "underflow is 0";

  for (const bool big : {false, true}) {
    std::string ply = test::tetra_ply_binary(big);
    std::string quarter_nan, one;
    test::append_bytes(quarter_nan, std::nan(""), big);
    test::append_bytes(one, 1.0, big);
    ply.replace(ply.find(one, ply.find("end_header")), one.size(), quarter_nan);
    EXPECT_NE(error_in(ply, "a.ply").find("vertex 1"), std::string::npos);
  }
  std::string stl = test::tetra_stl_binary();
  const float infinite = HUGE_VALF;
  std::memcpy(stl.data() + 84 + 12 + 12, &infinite, sizeof infinite);
  EXPECT_NE(error_in(stl, "a.stl").find("vertex 1"), std::string::npos);
}

TEST(ReadOff, HeadersCommentsAndColors) {
  const std::string body = "# a comment\n3 1 3\n0 0 0 # origin\n\n1 0 0\n0 1 0\n3 0 1 2 # face\n";
  EXPECT_EQ(parse("OFF\n" + body, "a.off").polygon_count(), 1u);
  EXPECT_EQ(parse(body, "a.off").polygon_count(), 1u) << "the header word may be missing";
  EXPECT_EQ(parse("# first\nOFF 3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off").polygon_count(), 1u);
  EXPECT_EQ(parse("OFF3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off").polygon_count(), 1u);
  EXPECT_EQ(parse("COFF3 1 3\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n", "none").polygon_count(), 1u);
  EXPECT_EQ(parse("OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off").polygon_count(), 1u);
  EXPECT_EQ(
      parse("COFF\n3 1 3\n0 0 0 255 0 0 255\n1 0 0 0 0 0 0\n0 1 0 1 1 1 1\n3 0 1 2 0.5 0.5 0.5\n", "a.off")
          .positions[1],
      Vec3(1, 0, 0));
  EXPECT_EQ(parse("NOFF\n3 1 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n", "a.off").polygon_count(),
            1u);
  EXPECT_EQ(parse("STOFF\n3 1 3\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n", "a.off").polygon_count(), 1u);
  EXPECT_EQ(
      parse("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n3 0 1 2 7\n", "a.off").corners.size(),
      7u);
}

TEST(ReadOff, Errors) {
  EXPECT_NE(error_in("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off").find("vertex 3"),
            std::string::npos);
  EXPECT_NE(error_in("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n", "a.off").find("line 6"),
            std::string::npos);
  EXPECT_NE(error_in("OFF\n9999999999 1 0\n0 0 0\n", "a.off").find("more than the file can hold"),
            std::string::npos);
  EXPECT_NE(error_in("OFF\n1 9999999999 0\n0 0 0\n", "a.off").find("more than the file can hold"),
            std::string::npos);
  EXPECT_NE(error_in("OFF\n1 1 0\n0 0 0\n4000000000 0 0 0\n", "a.off").find("more than"), std::string::npos);
  EXPECT_NE(error_in("OFF\n-1 1 0\n", "a.off").find("number of vertices"), std::string::npos);
  EXPECT_NE(error_in("OFF BINARY\n\1\2\3", "a.off").find("binary OFF"), std::string::npos);
  EXPECT_NE(error_in("4OFF\n1 1 1\n", "a.off").find("three dimensions"), std::string::npos);
  EXPECT_NE(
      error_in("OFF\n3 1 0 # as long as it should be\n0 0 0\n1 0 0 # and then\n", "a.off").find("ends where"),
      std::string::npos);
}

TEST(ReadPly, EveryScalarTypeOfAVertex) {
  const auto with_type = [](const std::string& type, const auto& one, bool big) {
    std::string ply = std::string("ply\r\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\r\n" +
                      "element vertex 3\r\nproperty " + type + " x\r\nproperty " + type + " y\r\nproperty " +
                      type +
                      " z\r\nelement face 1\r\nproperty list char uint8 vertex_indices\r\nend_header\r\n";
    const auto zero = decltype(one + one)(0);
    for (int v = 0; v < 3; ++v) {
      for (int k = 0; k < 3; ++k) {
        test::append_bytes(ply, v == k ? one : static_cast<std::decay_t<decltype(one)>>(zero), big);
      }
    }
    return ply + std::string("\3\0\1\2", 4);
  };
  const auto check = [&](const std::string& type, const auto& value) {
    for (const bool big : {false, true}) {
      const PolygonSoup soup = parse(with_type(type, value, big), "a.ply");
      EXPECT_EQ(soup.positions[1], Vec3(0, static_cast<double>(value), 0)) << type << big;
    }
  };
  check("char", std::int8_t{-100});
  check("uint8", std::uint8_t{200});
  check("short", std::int16_t{-30000});
  check("ushort", std::uint16_t{60000});
  check("int", std::int32_t{-2000000000});
  check("uint32", std::uint32_t{4000000000});
  check("int64", std::int64_t{-5});
  check("uint64", std::uint64_t{5});
  check("float", 0.1f);
  check("float64", 0.1);
}

TEST(ReadPly, FacesMayComeFirstAndHaveAnySize) {
  const PolygonSoup soup = parse(
      "ply\nformat ascii 1.0\nobj_info x\nelement face 3\nproperty list int int vertex_index\nproperty int "
      "tag\n"
      "element vertex 5\nproperty double z\nproperty double y\nproperty double x\nproperty list int int "
      "more\n"
      "element none 99999999999999\nend_header\n"
      "5 0 1 2 3 4 9\n2 0 1 9\n3 2 1 0 9\n0 0 1 0\n0 1 1 0\n0 1 2 1 5\n0 0 3 0\n0 0 4 0",
      "a.ply");
  EXPECT_EQ(soup.first_corner, (std::vector<std::uint32_t>{0, 5, 7, 10}));
  EXPECT_EQ(soup.positions[2], Vec3(2, 1, 0));
  const Triangulation triangulation = triangulate(soup);
  EXPECT_EQ(triangulation.triangles.size(), 4u);
  EXPECT_EQ(triangulation.triangles[2], (IndexedTriangle{0, 3, 4}));
  EXPECT_EQ(triangulation.source_polygon, (std::vector<std::uint32_t>{0, 0, 0, 2}));
  EXPECT_EQ(triangulation.report.divided, 1u);
  EXPECT_EQ(triangulation.report.skipped, 1u);
}

TEST(ReadPly, Errors) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string ply = test::tetra_ply_ascii();
    return error_in(ply.replace(ply.find(from), from.size(), to), "a.ply");
  };
  const auto expect_part = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect_part(changed("ascii", "binary_middle_endian"), "unknown format");
  expect_part(changed("format ascii 1.0\n", ""), "no 'format'");
  expect_part(changed("float x", "half x"), "unknown type 'half'");
  expect_part(changed("float x", "float u"), "lacks the property x, y or z");
  expect_part(changed("vertex_indices", "corners"), "lacks a list");
  expect_part(changed("uchar int", "float int"), "floating-point");
  expect_part(changed("uchar int", "uchar float"), "lacks a list");
  expect_part(changed("vertex 4", "vertex 4000000000000"), "room for only");
  expect_part(changed("face 4", "face 4000000000000"), "room for only");
  expect_part(changed("face 4", "face -4"), "is '-4'");
  expect_part(changed("face 4", "vertex 4"), "declared twice");
  expect_part(changed("element vertex 4\n", ""), "before the first element");
  expect_part(changed("end_header", "end_heade"), "unknown header line");
  expect_part(changed("3 0 2 1", "3 0 2 4"), "face 0 uses vertex 4");
  expect_part(changed("3 0 2 1", "3 0 2 -1"), "uses vertex -1");
  expect_part(changed("3 0 2 1", "3 0 2 1.5"), "face 0");
  expect_part(changed("3 0 2 1", "3000000000 0 2 1"), "longer than the file");
  expect_part(changed("1 0 0", "1 0 what"), "'what'");
  expect_part(changed("1 0 0", "1 0 nan"), "vertex 1");
  expect_part(changed("element face 4\nproperty list uchar int vertex_indices\n", ""), "no faces");
}

TEST(ReadStl, AsciiInAnyLayout) {
  EXPECT_EQ(
      parse("SOLID\nFacet Normal nan nan nan Outer Loop Vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
            "endfacet\n"
            "endsolid\nsolid two\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
            "endloop\nendfacet\nendsolid two\n",
            "a.stl")
          .polygon_count(),
      2u);
}

TEST(ReadStl, Errors) {
  std::string stl = test::tetra_stl_binary();
  stl[0] = 'x';
  EXPECT_EQ(parse(stl + "trailing", "a.stl").polygon_count(), 4u);
  EXPECT_NE(error_in(stl.substr(0, stl.size() - 1), "a.stl").find("room for only 3"), std::string::npos);
  EXPECT_NE(error_in("x", "a.stl").find("nor long enough"), std::string::npos);
  EXPECT_NE(error_in("solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0\n", "a.stl").find("line 5"),
            std::string::npos);
  EXPECT_NE(error_in("solid\nfoo\nendsolid\n", "a.stl").find("'foo'"), std::string::npos);
  EXPECT_NE(error_in("solid\nendsolid\n", "a.stl").find("no faces"), std::string::npos);
}

TEST(WriteMesh, RoundTripsInEveryFormat) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = make_icosphere({0.1, 1e-7, -1e5}, 1.0 / 3.0, 2);
  for (const char* name : {"a.ply", "a.obj", "a.off", "A.OFF"}) {
    write_mesh(folder / name, mesh);
    const TriangleMesh again = read_mesh(folder / name);
    EXPECT_TRUE(std::ranges::equal(mesh.positions(), again.positions())) << name;
    EXPECT_TRUE(std::ranges::equal(mesh.triangles(), again.triangles())) << name;
  }
  const TriangleMesh unit = make_icosphere({0, 0, 0}, 1.0, 2);
  write_mesh(folder / "a.stl", unit);
  const TriangleMesh again = read_mesh(folder / "a.stl");
  EXPECT_TRUE(again.is_closed());
  EXPECT_EQ(again.triangles().size(), unit.triangles().size());
  EXPECT_NEAR(again.components()[0].signed_volume, unit.components()[0].signed_volume, 1e-5);
  EXPECT_EQ(folder.file_count(), 5u);
}

TEST(WriteMesh, LargeFilesComeInSeveralPieces) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = make_icosphere({0, 0, 0}, 1, 6);
  for (const char* name : {"a.ply", "a.obj", "a.stl"}) {
    write_mesh(folder / name, mesh);
    EXPECT_GT(std::filesystem::file_size(folder / name), 3u << 19);
    EXPECT_EQ(read_mesh(folder / name).triangles().size(), mesh.triangles().size());
  }
}

TEST(WriteMesh, Errors) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = make_box({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(write_mesh(folder / "a.txt", mesh), UsageError);
  EXPECT_THROW(write_mesh(folder / "ply", mesh), UsageError);
  EXPECT_THROW(write_mesh(folder / "none" / "a.ply", mesh), SystemError);
  EXPECT_THROW(write_mesh(folder / "a.stl", make_box({0, 0, 0}, {1e39, 1, 1})), UsageError);
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace penumbra
