#include <cstdint>
#include <ostream>

#include "mesh/io/formats.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/volumes/sections/plane_section.h"
#include "volumes/sections/section_svg.h"

namespace penumbra {
namespace {

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
    extension == ".svg" ? detail::write_section_svg(out, sections, plane) : write_ply(out, sections);
  });
}

}  // namespace penumbra
