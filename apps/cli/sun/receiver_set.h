// Receivers that people give: points of a file, or the vertices or faces of a scene's objects.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

struct ReceiverSet {
  std::vector<Vec3> points, normals{};
  std::vector<std::int32_t> objects{};
  std::vector<std::uint32_t> faces{};

  std::size_t size() const { return points.size(); }
  /// Refers to this.
  Receivers receivers() const {
    return {.points = points, .normals = normals, .objects = objects, .faces = faces};
  }
};

/// Points of .csv (x, y, z and perhaps a normal, one point a line; a line of names may be first), .npy (shape
/// (n, 3) or (n, 6)) or .ply (vertices, with nx, ny, nz or without). Normals of any length but 0. Throws
/// MeshError with the line or row.
ReceiverSet read_receivers(const std::filesystem::path& path);

enum class ReceiverPlace { kVertices, kFaces };
/// The centers of an object's faces with the faces' normals; or its vertices with the mean of the faces'
/// normals, weighted by area. A vertex whose faces cancel each other is left out. `object`: as for
/// surface_of.
ReceiverSet receivers_on(const Scene& scene, const std::string& object, ReceiverPlace place);

}  // namespace penumbra::apps
