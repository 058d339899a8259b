// Area lights of glTF (EXT_lights_area, a draft of 2025) as a scene's: rectangles and disks that shine along
// their node's -z.
//
//   size         of a rectangle along its node's y, of a disk the diameter; times the largest scale of the
//                node
//   rect.aspect  a rectangle's width over its height
//   intensity    nits, which count as W/(m² sr): the radiance
#pragma once

#include <optional>

#include "penumbra/render/light/light.h"
#include "render/scene/gltf/gltf_file.h"
#include "render/scene/gltf/gltf_notes.h"
#include "render/scene/transform.h"

namespace penumbra::detail {

inline constexpr const char* kAreaLights = "EXT_lights_area";

/// The area light that a node at `world` has, with the name that the file gives it, which may be empty.
/// std::nullopt where the node has none, and where its type is unknown, which `notes` then say. `where` names
/// the node. Throws SceneError where it refers to no light, or has no size.
std::optional<Light> read_gltf_area_light(const GltfFile& file, const tinygltf::Node& node,
                                          const std::string& where, const Transform& world, GltfNotes& notes);

}  // namespace penumbra::detail
