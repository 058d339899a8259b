#include <gtest/gtest.h>

#include "mesh/io/read_mtl.h"
#include "penumbra/mesh/inspect.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using test::TemporaryFolder;
using test::write_text;

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::optional<Vec3> color_in(const std::string& lines) {
  const detail::MaterialLibrary library = detail::read_mtl(test::bytes_of("newmtl a\n" + lines));
  EXPECT_EQ(library.materials.size(), 1u);
  return library.materials[0].color;
}

TEST(ReadMtl, DiffuseColors) {
  EXPECT_EQ(color_in("Ka 1 1 1\nKd 0.1 .2 3e-1\nKs 0 0 0\n"), Vec3(.1, .2, .3));
  EXPECT_EQ(color_in("Kd 0.5\n"), Vec3(.5));
  EXPECT_EQ(color_in("  Kd -1 0.5 7 # beyond what reflects\n"), Vec3(0, .5, 1));
  EXPECT_EQ(color_in("Ka 1 1 1\n"), std::nullopt);
  for (const char* none :
       {"Kd spectral file.rfl 1\n", "Kd xyz 1 1 1\n", "Kd\n", "Kd nan 0 0\n", "Kd 1 1e999 0\n"})
    EXPECT_EQ(color_in(none), std::nullopt) << none;
  const detail::MaterialLibrary two = detail::read_mtl(
      test::bytes_of("Kd 1 0 0\nnewmtl my red\nmap_Kd a.png\nKd 1 0 0\nnewmtl b\r\nKd 0 1 0\r\n"));
  ASSERT_EQ(two.materials.size(), 2u);
  EXPECT_EQ(two.materials[0].name, "my red");
  EXPECT_EQ(two.materials[1].color, Vec3(0, 1, 0));
  EXPECT_TRUE(two.has_textures);
  EXPECT_TRUE(detail::read_mtl(test::bytes_of("\xFF\x00 no text at all")).materials.empty());
}

TEST(Materials, OfPolygons) {
  const PolygonSoup soup = test::parse(
      kCorners + "f 1 2 3\nusemtl red\nf 1 2 3\nf 1 3 4\nusemtl dark  blue\nf 1 2 4\nusemtl red\nf 2 3 4\n",
      "a.obj");
  ASSERT_EQ(soup.materials.size(), 2u);
  EXPECT_EQ(soup.materials[1].name, "dark blue");
  EXPECT_EQ(soup.polygon_material, (std::vector<std::uint32_t>{PolygonSoup::kNoMaterial, 0, 0, 1, 0}));
  EXPECT_TRUE(test::parse(kCorners + "f 1 2 3\n", "a.obj").polygon_material.empty());
}

TEST(Materials, NamesMayHaveTheCommentsCharacter) {
  const PolygonSoup soup = test::parse(
      kCorners + "usemtl Material #25\nf 1 2 3\nusemtl Material #26 # the other\nf 1 3 4\n", "a.obj");
  ASSERT_EQ(soup.materials.size(), 2u);
  EXPECT_EQ(soup.materials[0].name, "Material #25");
  EXPECT_EQ(soup.materials[1].name, "Material #26");
  const detail::MaterialLibrary library =
      detail::read_mtl(test::bytes_of("newmtl Material #25\nKd 1 0 0\nnewmtl Material #26\nKd 0 1 0\n"));
  ASSERT_EQ(library.materials.size(), 2u);
  EXPECT_EQ(library.materials[1].name, "Material #26");
}

TEST(Materials, ComeFromFilesBesideTheMesh) {
  const TemporaryFolder folder;
  write_text(folder / "my colors.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\nnewmtl unused\nKd 0 0 0\n");
  write_text(folder / "b.mtl", "newmtl red\nKd 0 0 1\nnewmtl green\nKd 0 1 0\n");
  write_text(folder / "a.obj", "mtllib my colors.mtl\nmtllib none.mtl b.mtl\n" + kCorners +
                                   "usemtl red\nf 1 2 3\nusemtl green\nf 1 3 4\nusemtl plain\nf 2 3 4\n");
  const LoadedMesh loaded = load_mesh(folder / "a.obj");
  ASSERT_EQ(loaded.materials.size(), 3u);
  EXPECT_EQ(loaded.materials[0].color, Vec3(1, 0, 0)) << "the first one counts";
  EXPECT_EQ(loaded.materials[1].color, Vec3(0, 1, 0));
  EXPECT_EQ(loaded.materials[2].color, std::nullopt);
  EXPECT_EQ(loaded.ignored,
            (std::vector<std::string>{"textures", "materials of 'none.mtl', which cannot be read"}));
  const std::string text = to_text(inspect(loaded));
  EXPECT_NE(text.find("materials     3, 2 with a diffuse color\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace penumbra
