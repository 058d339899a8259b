// Sections of shapes whose sections are known, and their files.
#include "penumbra/volumes/sections/plane_section.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"

namespace penumbra {
namespace {

Section section_of(const TriangleMesh& mesh, const SectionPlane& plane) {
  return plane_section(mesh.positions(), mesh.triangles(), plane);
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(PlaneSection, OfABoxIsARectangle) {
  const Section s = section_of(make_box(Vec3(1.0, 2.0, 3.0), Vec3(0.5, 1.0, 2.0)), {Vec3(0.0, 2.3, 0.0)});
  ASSERT_EQ(s.curves.size(), 1u);
  EXPECT_TRUE(s.curves[0].closed);
  EXPECT_NEAR(s.area, 1.0 * 4.0, 1e-12);
  EXPECT_NEAR(s.length, 2.0 * (1.0 + 4.0), 1e-12);
  for (const Vec3& p : s.curves[0].points) EXPECT_DOUBLE_EQ(p.y, 2.3);
}

TEST(PlaneSection, ThroughVerticesIsClosedToo) {
  // Every vertex of two of the box's sides is in the plane; and a plane through two edges of it.
  EXPECT_TRUE(section_of(make_box(Vec3(0.0), Vec3(1.0)), {Vec3(0.0, 1.0, 0.0)}).curves.empty());
  const Section below = section_of(make_box(Vec3(0.0), Vec3(1.0)), {Vec3(0.0, -1.0, 0.0)});
  EXPECT_NEAR(below.area, 4.0, 1e-12);
  const Section across = section_of(make_box(Vec3(0.0), Vec3(1.0)), {Vec3(0.0), Vec3(1.0, 1.0, 0.0)});
  ASSERT_EQ(across.curves.size(), 1u);
  EXPECT_NEAR(across.area, 2.0 * 2.0 * std::numbers::sqrt2, 1e-9);
}

TEST(PlaneSection, OfATorusHasAHole) {
  const TriangleMesh torus = make_torus(Vec3(0.0), 1.0, 0.3, 96, 48);
  const Section level = section_of(torus, {Vec3(0.0, 0.01, 0.0)});
  ASSERT_EQ(level.curves.size(), 2u);
  EXPECT_NEAR(level.area, std::numbers::pi * (1.3 * 1.3 - 0.7 * 0.7), 0.02);
  const Section upright = section_of(torus, {Vec3(0.0), Vec3(1.0, 0.0, 0.0)});
  ASSERT_EQ(upright.curves.size(), 2u);
  EXPECT_NEAR(upright.area, 2.0 * std::numbers::pi * 0.3 * 0.3, 0.02);
}

TEST(PlaneSection, OfAnOpenMeshIsOpen) {
  const TriangleMesh triangle =
      make_triangle(Vec3(0.0, -1.0, 0.0), Vec3(2.0, -1.0, 0.0), Vec3(0.0, 1.0, 0.0));
  const Section s = section_of(triangle, {Vec3(0.0)});
  ASSERT_EQ(s.curves.size(), 1u);
  EXPECT_FALSE(s.curves[0].closed);
  EXPECT_EQ(s.curves[0].points.size(), 2u);
  EXPECT_NEAR(s.length, 1.0, 1e-12);
  EXPECT_EQ(s.area, 0.0);
}

TEST(PlaneSection, RefusesAPlaneWithoutNormal) {
  EXPECT_THROW(section_of(make_box(Vec3(0.0), Vec3(1.0)), {Vec3(0.0), Vec3(0.0)}), UsageError);
}

TEST(PlaneSection, IsWrittenAsCurves) {
  const SectionPlane plane{Vec3(0.0, 0.2, 0.0)};
  const std::vector<NamedSection> sections{{"ball", section_of(make_icosphere(Vec3(0.0), 0.5, 2), plane)},
                                           {"a<b", section_of(make_box(Vec3(0.0), Vec3(1.0)), plane)}};
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::filesystem::path svg = folder / "penumbra_section.svg", ply = folder / "penumbra_section.ply";
  write_sections(svg, sections, plane);
  write_sections(ply, sections, plane);
  const std::string picture = text_of(svg), lines = text_of(ply);
  EXPECT_NE(picture.find("<title>a&lt;b</title>"), std::string::npos);
  // In scene units; the larger one first, so that it covers nothing.
  EXPECT_NE(picture.find("viewBox=\"0 0 2 2\""), std::string::npos) << picture.substr(0, 400);
  EXPECT_LT(picture.find("<title>a&lt;b</title>"), picture.find("<title>ball</title>"));
  EXPECT_NE(picture.find(">a&lt;b<tspan fill=\"#777\">, area 4</tspan>"), std::string::npos);
  EXPECT_NE(picture.find(">0.5 scene units</text>"), std::string::npos);
  std::size_t points = 0;
  for (const NamedSection& s : sections) points += s.section.curves.at(0).points.size();
  const std::string count = std::to_string(points);
  EXPECT_NE(lines.find("element vertex " + count + "\n"), std::string::npos);
  EXPECT_NE(lines.find("element edge " + count + "\n"), std::string::npos);
  const std::size_t header = lines.find("end_header\n") + 11;
  EXPECT_EQ(lines.size() - header, points * (3 * sizeof(double) + 3 * sizeof(std::int32_t)));
  EXPECT_THROW(write_sections(folder / "s.txt", sections, plane), UsageError);
  std::filesystem::remove(svg);
  std::filesystem::remove(ply);
}

}  // namespace
}  // namespace penumbra
