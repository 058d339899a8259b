// Sections: where a plane cuts the surface of a mesh, as curves. What a shadow solid leaves on a wall.
//
// A vertex in the plane counts as behind it, so that every triangle is cut in one segment or not at all, and
// a closed surface gives closed curves.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra {

struct SectionPlane {
  Vec3 point{0.0};
  Vec3 normal{0.0, 1.0, 0.0};  ///< of any length but 0
};

struct SectionCurve {
  std::vector<Vec3> points;
  /// From the last point back to the first.
  bool closed = true;
};

struct Section {
  /// Seen against the normal, the solid lies to the left of its curves.
  std::vector<SectionCurve> curves;
  double length = 0.0;  ///< scene units
  /// Scene units²: what closed curves enclose. Of a closed surface that is oriented outward, the area of the
  /// solid in the plane.
  double area = 0.0;
};

/// Throws UsageError where the normal is 0 or not finite. Cost O(triangles + curves · log).
Section plane_section(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                      const SectionPlane& plane);

struct NamedSection {
  std::string name;
  Section section;
};

/// The extensions that write_sections knows: lower case, with the dot.
std::vector<std::string_view> section_extensions();

/// Writes sections by one plane: SVG, a drawing seen against the normal, each section a path in scene units,
/// the largest first, with names, areas and a scale bar; or PLY with vertices and edges in space, `section`
/// of each edge being the number of its section. The file is written whole or not at all. Throws UsageError
/// for another extension, SystemError where writing fails.
void write_sections(const std::filesystem::path& path, std::span<const NamedSection> sections,
                    const SectionPlane& plane);

}  // namespace penumbra
