#include "mesh/io/formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using detail::MeshFormat;
using test::mesh_error_of;
using test::TemporaryFolder;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string_view recognized(const std::string& text, const std::string& name) {
  return detail::recognize_format(bytes_of(text), name).name;
}

TEST(Formats, ReadBackWhatTheyWrite) {
  const TemporaryFolder folder;
  const TriangleMesh box = make_box({0.5, 1.0, 2.0}, {0.5, 0.25, 1.0});  // exact in float too
  for (const MeshFormat& format : detail::mesh_formats()) {
    SCOPED_TRACE(format.name);
    const std::filesystem::path path = folder / ("box" + std::string(format.extension));
    write_mesh(path, box);
    const TriangleMesh back = read_mesh(path);
    EXPECT_EQ(back.triangles().size(), box.triangles().size());
    EXPECT_EQ(back.components()[0].signed_volume, box.components()[0].signed_volume);
  }
}

TEST(Formats, HaveExtensionsAndNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const MeshFormat& format : detail::mesh_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_TRUE(names.insert(format.extension).second) << format.extension;
    EXPECT_EQ(detail::lower_extension(std::string("a") + std::string(format.extension)), format.extension);
  }
  EXPECT_EQ(mesh_extensions().size(), detail::mesh_formats().size());
}

TEST(Formats, AreAllNamedWhereNoneFits) {
  const std::string unread = mesh_error_of([] { recognized("hello", "a.txt"); });
  std::string unwritten;
  try {
    write_mesh("a.txt", TriangleMesh());
  } catch (const UsageError& e) {
    unwritten = e.what();
  }
  for (const MeshFormat& format : detail::mesh_formats()) {
    EXPECT_NE(unread.find(format.name), std::string::npos) << unread;
    EXPECT_NE(unwritten.find(format.extension), std::string::npos) << unwritten;
    EXPECT_NE(mesh_format_names().find(format.name), std::string::npos) << mesh_format_names();
  }
}

TEST(Formats, MagicOfPlyIsStrongerThanAnExtensionAndOthersWeaker) {
  EXPECT_EQ(recognized("ply\n", "a.obj"), "PLY");
  EXPECT_EQ(recognized("OFF\n", "a.obj"), "OBJ");
  EXPECT_EQ(recognized("solid x\n", "a.off"), "OFF");
  EXPECT_EQ(recognized("OFF\n", "a.stl"), "STL");
}

TEST(Formats, WithoutTheMagicAFileNamedPlyIsWhatItBeginsAs) {
  EXPECT_EQ(recognized("COFF\n", "a.ply"), "OFF");
  EXPECT_EQ(recognized("solid x\n", "a.ply"), "STL");
  std::string stl = test::tetra_stl_binary();
  stl.replace(0, 80, 80, ' ');  // its header begins with "solid"
  EXPECT_EQ(recognized(stl, "a"), "STL");
  EXPECT_THROW(recognized(stl, "a.ply"), MeshError);
}

TEST(OneOf, ListsNames) {
  const std::vector<std::string_view> names{"a", "b", "c"};
  EXPECT_EQ(detail::one_of(std::span(names).first(1)), "a");
  EXPECT_EQ(detail::one_of(std::span(names).first(2)), "a or b");
  EXPECT_EQ(detail::one_of(names), "a, b or c");
}

}  // namespace
}  // namespace penumbra
