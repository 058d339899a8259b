// Lights and cameras of glTF as a scene's.
//
// KHR_lights_punctual knows points, and a scene needs sizes: they are in a light's or its node's `extras`, or
// options say them.
//
//   directional  the sun: a distant disk of `extras.angle_degrees`, or of .53 degrees
//   spot, point  a disk of `extras.radius`, or of 1/50 of the casters' diagonal. A spot shines along its
//                node's -z, its cone is ignored; a point has no side: its disk faces the middle of the
//                casters
//   intensity    lux and candela count as W/m² and W/sr: of a disk of radius r it is the radiance π r² times
//
// EXT_lights_area has sizes (gltf_area_lights.h).
#pragma once

#include <optional>
#include <span>

#include "penumbra/render/scene/scene.h"
#include "render/scene/gltf/gltf_nodes.h"

namespace penumbra::detail {

/// One line of `warnings` for each light that has no size of its own.
std::vector<Light> read_gltf_lights(const GltfFile& file, std::span<const PlacedNode> nodes,
                                    const Bounds& casters, const SceneOptions& options, GltfNotes& notes,
                                    std::vector<std::string>& warnings);

/// The first perspective camera of the nodes.
std::optional<Camera> read_gltf_camera(const GltfFile& file, std::span<const PlacedNode> nodes,
                                       const Bounds& bounds, GltfNotes& notes);

}  // namespace penumbra::detail
