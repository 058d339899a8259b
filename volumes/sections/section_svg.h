// Sections as a drawing.
#pragma once

#include <iosfwd>
#include <span>

#include "penumbra/volumes/sections/plane_section.h"

namespace penumbra::detail {

/// A sheet with the sections filled, the largest first, a legend with their names and areas, and a scale bar.
/// Paths are in scene units, in an <svg> of their own.
void write_section_svg(std::ostream& out, std::span<const NamedSection> sections, const SectionPlane& plane);

}  // namespace penumbra::detail
