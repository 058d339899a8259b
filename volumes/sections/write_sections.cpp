#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <ostream>

#include "mesh/io/formats.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/sections/plane_section.h"

namespace penumbra {
namespace {

constexpr double kPicture = 800.0;  ///< pixels along the longer side
constexpr double kRoom = 0.05;      ///< of the longer side, around

/// Right and up of a plane seen against its normal. Up is as near to the y axis as can be, or to -z where the plane is level.
struct PlaneAxes {
  explicit PlaneAxes(const SectionPlane& plane) {
    const Vec3 n = glm::normalize(plane.normal);
    const Vec3 upright = std::abs(n.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(0.0, 0.0, -1.0);
    right = glm::normalize(glm::cross(upright, n));
    up = glm::cross(n, right);
  }
  Vec3 right, up;
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

void write_svg(std::ostream& out, std::span<const NamedSection> sections, const SectionPlane& plane) {
  const PlaneAxes axes(plane);
  const auto flat = [&](const Vec3& p) {
    return Vec3(glm::dot(axes.right, p - plane.point), -glm::dot(axes.up, p - plane.point), 0.0);
  };
  Bounds box;
  for (const NamedSection& s : sections)
    for (const SectionCurve& curve : s.section.curves)
      for (const Vec3& p : curve.points) box.add(flat(p));
  if (box.empty()) box.add(Vec3(0.0));
  const Vec3 size = box.high - box.low;
  const double longer = std::max({size.x, size.y, 1e-12}), room = kRoom * longer;
  const double width = size.x + 2.0 * room, height = size.y + 2.0 * room,
               scale = kPicture / std::max(width, height);
  out.precision(9);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << std::ceil(scale * width) << "\" height=\""
      << std::ceil(scale * height) << "\" viewBox=\"" << box.low.x - room << ' ' << box.low.y - room << ' '
      << width << ' ' << height << "\">\n";
  for (const NamedSection& s : sections) {
    out << "<path fill=\"#000\" fill-opacity=\"0.35\" fill-rule=\"evenodd\" stroke=\"#000\" stroke-width=\""
        << 1.5 / scale << "\" d=\"";
    for (const SectionCurve& curve : s.section.curves) {
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Vec3 p = flat(curve.points[i]);
        out << (i == 0 ? "M" : "L") << p.x << ' ' << p.y;
      }
      out << (curve.closed ? "Z" : "");
    }
    out << "\"><title>" << escaped(s.name) << "</title></path>\n";
  }
  out << "</svg>\n";
}

template <class T>
void put(std::ostream& out, T value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_ply(std::ostream& out, std::span<const NamedSection> sections) {
  std::size_t points = 0, edges = 0;
  for (const NamedSection& s : sections)
    for (const SectionCurve& curve : s.section.curves) {
      points += curve.points.size();
      edges += curve.points.size() - (curve.closed ? 0 : 1);
    }
  out << "ply\nformat binary_little_endian 1.0\n";
  for (std::size_t k = 0; k < sections.size(); ++k)
    out << "comment section " << k << ": " << sections[k].name << '\n';
  out << "element vertex " << points
      << "\nproperty double x\nproperty double y\nproperty double z\nelement edge " << edges
      << "\nproperty int vertex1\nproperty int vertex2\nproperty int section\nend_header\n";
  for (const NamedSection& s : sections)
    for (const SectionCurve& curve : s.section.curves)
      for (const Vec3& p : curve.points)
        for (int k = 0; k < 3; ++k) put(out, p[k]);
  std::int32_t first = 0;
  for (std::size_t k = 0; k < sections.size(); ++k)
    for (const SectionCurve& curve : sections[k].section.curves) {
      const auto count = static_cast<std::int32_t>(curve.points.size());
      for (std::int32_t i = 0; i < count - (curve.closed ? 0 : 1); ++i) {
        put(out, first + i);
        put(out, first + (i + 1) % count);
        put(out, static_cast<std::int32_t>(k));
      }
      first += count;
    }
}

}  // namespace

std::vector<std::string_view> section_extensions() {
  return {".svg", ".ply"};
}

void write_sections(const std::filesystem::path& path, std::span<const NamedSection> sections,
                    const SectionPlane& plane) {
  const std::string extension = detail::lower_extension(path);
  if (extension != ".svg" && extension != ".ply")
    throw UsageError(path.string() +
                     ": sections are written as .svg or .ply; choose one of these extensions");
  write_file(path, [&](std::ostream& out) {
    extension == ".svg" ? write_svg(out, sections, plane) : write_ply(out, sections);
  });
}

}  // namespace penumbra
