// A scene: lights, a camera, objects in world space. Read from JSON (or a bare mesh file), with warnings for
// what was not understood.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/render/light/light.h"
#include "penumbra/render/scene/camera.h"
#include "penumbra/render/scene/picture_settings.h"

namespace penumbra {

/// Colors of single faces.
struct FaceColors {
  std::vector<Vec3> colors{};
  /// For each face of the mesh a number in `colors`.
  std::vector<std::uint32_t> of_face{};
};

struct SceneObject {
  /// The mesh's path as the scene file has it.
  std::string name{};
  /// In world space.
  TriangleMesh mesh{};
  /// Linear RGB.
  Vec3 albedo{0.8};
  /// Whether it hides lights from what lies behind it.
  bool casts = true;
  /// Unit normals at the corners of each face, for smooth shading: only RGB depends on them. Empty: faces are
  /// flat.
  std::vector<std::array<glm::vec3, 3>> corner_normals{};
  /// Texture coordinates at the corners of each face, (0, 0) at the texture's upper left corner: the set that
  /// SceneOptions::uv_set asks for. NaN where the file gives a corner none. Empty: none were read.
  std::vector<std::array<glm::dvec2, 3>> corner_uv{};
  /// Albedos where its faces have several: empty, or one for each face, which then counts instead.
  FaceColors face_albedo{};
  /// Only the shadow on it is shown: black, as opaque as the shadow is dark.
  bool shadow_catcher = false;
  /// From which distance from a point (the middle of its bounds, unless it is given) it fades into the
  /// background, and at which it has faded. 0: nowhere.
  struct Fade {
    double from = 0.0, to = 0.0;
    std::optional<Vec3> middle{};
  } fade{};

  const Vec3& albedo_of(std::uint32_t face) const {
    return face < face_albedo.of_face.size() ? face_albedo.colors[face_albedo.of_face[face]] : albedo;
  }
};

/// A closed mesh that pictures show as tinted glass over what stands behind it. It hides no light and gets no
/// shadow.
struct GlassBody {
  /// In world space.
  TriangleMesh mesh{};
  /// Linear RGB: the color of a way through it that is long. That of a short one is nearly what stands
  /// behind.
  Vec3 tint{1.0};
  /// The share of what stands behind that a way as long as the casters' diagonal hides, 0 to 1.
  double density = 0.5;
};

struct Scene {
  /// At least one in a scene that was read.
  std::vector<Light> lights;
  Camera camera;
  std::vector<SceneObject> objects;
  PictureSettings picture{};
  std::vector<GlassBody> glass{};
  /// The file as read, JSON, keys beginning with `x-` included; empty for a scene made by hand, {} for one of
  /// glTF.
  std::string document;
  /// What was read for it: the scene's file, its meshes, their files of materials.
  std::vector<std::filesystem::path> files{};

  /// Of all objects.
  Bounds bounds() const;
  /// Of the objects that cast.
  Bounds caster_bounds() const;
  /// The index of the light of that name or, where the text is a number, of that index. Throws UsageError
  /// that lists the lights.
  std::size_t light_index(std::string_view name_or_index) const;
};

struct SceneOptions {
  /// Unknown keys are errors, not warnings.
  bool strict = false;
  /// Of lights in glTF files, which have no size: the radius of points and spots, scene units, and the angle
  /// of directional ones, degrees. Without, `extras` of the file say it.
  std::optional<double> light_radius{}, sun_angle{};
  /// The set of texture coordinates of glTF files that is read: TEXCOORD_0 or a further one. Without, none
  /// is.
  std::optional<int> uv_set{};
};

struct LoadedScene {
  Scene scene;
  /// One line each: unknown keys, what meshes needed (faces left out, split vertices).
  std::vector<std::string> warnings;
};

/// Reads a scene file (*.json) or a glTF file (*.gltf, *.glb), or makes a scene of a bare mesh: the mesh on a
/// floor that does not cast, with a light and a camera that suit its bounds. Relative mesh paths start at the
/// scene file's folder. Throws SceneError or MeshError.
LoadedScene load_scene(const std::filesystem::path& path, const SceneOptions& options = {});

/// The same from the text of a scene file; `folder` is where relative mesh paths start, `name` is used in
/// messages.
LoadedScene parse_scene(std::string_view text, const std::filesystem::path& folder, const std::string& name,
                        const SceneOptions& options = {});

/// The same from the bytes of any: a scene file where the first character is a brace, a binary glTF file
/// where they begin as one does, else a mesh file.
LoadedScene parse_scene_or_mesh(std::string_view bytes, const std::filesystem::path& folder,
                                const std::string& name, const SceneOptions& options = {});

}  // namespace penumbra
