// Fields: the fraction O of a light that each point of a grid sees, for fog, light shafts and measurements in
// other tools.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "penumbra/render/visibility.h"

namespace penumbra {

/// Points origin + (i, j, k) · step; i runs fastest.
struct LightField {
  Vec3 origin{0.0}, step{1.0};
  std::array<int, 3> counts{};
  /// O: 0 in umbra and behind the light's plane, 1 where all is seen.
  std::vector<float> seen;
};

/// `counts` points along each axis, from the box's lowest corner to its highest; at least 2 along each.
/// Blocks of points that are proved to be lit are not looked at one by one. On the casters' threads. Cost:
/// the call for visibility at all other points, four bytes a point. Throws UsageError for a rectangle, an
/// empty box, or counts out of range (2 to 2,048); Cancelled.
LightField light_field(const Casters& casters, const LightShape& light, const Bounds& box,
                       const std::array<int, 3>& counts, const Progress& progress = {});

/// The extensions that write_light_field knows: lower case, with the dot.
std::vector<std::string_view> light_field_extensions();

/// Writes what the extension names: VTK's image data (.vti); an array for NumPy (.npy) of shape (z, y, x),
/// float32; or a grid `seen` of OpenVDB (.vdb) with background 1, tiles where 0 or 1 fills them, and the
/// field's place in space. The file is written whole or not at all. OpenVDB is opened by the first .vdb, by a
/// module that the loader must find (docs/library.md). Throws UsageError for another extension; SystemError
/// where OpenVDB or its module is not installed, or writing fails.
void write_light_field(const std::filesystem::path& path, const LightField& field);

/// Throws what write_light_field would throw for such a path whatever the field: to be called before a long
/// computation.
void require_light_field_format(const std::filesystem::path& path);

}  // namespace penumbra
