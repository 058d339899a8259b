// A solid as triangles for OpenGL, with normals that are smooth but for sharp edges.
#pragma once

#include <vector>

#include "penumbra/volumes/shadow_mesh.h"

namespace penumbra::viewer {

struct SolidVertex {
  float x, y, z;  ///< relative to an origin
  float nx, ny, nz;
};

/// Three vertices a triangle. A corner's normal is the mean, by area, of the triangles around it whose planes
/// are within 35 degrees of its own.
std::vector<SolidVertex> solid_triangles(const ShadowMesh& mesh, const Vec3& origin);

}  // namespace penumbra::viewer
