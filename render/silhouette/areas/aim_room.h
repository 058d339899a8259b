// Silhouette method, step area: whether there is room round a point of the disk.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "render/silhouette/areas/disk_part.h"
#include "render/silhouette/edges/projected_segment.h"

namespace penumbra::detail {

/// A point of D is farther than `room` from all segments and from D's boundary. Cost O(segments).
bool has_room(const glm::dvec2& point, double room, std::span<const Segment> segments, const DiskPart& part);

}  // namespace penumbra::detail
