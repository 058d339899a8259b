// Embree's side of RayScene, for the sources of render/rays.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <vector>

#include "penumbra/mesh/error.h"
#include "render/rays/group_rays.h"
#include "render/rays/ray_groups.h"
#include "render/rays/ray_scene.h"
#include "render/rays/segment_face.h"

namespace penumbra {
namespace detail {

/// Faces of one object in a group's hierarchy: Embree's geometry of that number, and its user data.
struct RayGeometry {
  RayGeometry(const TriangleMesh& mesh, const RayPart& part, const GroupFrame& frame);

  std::size_t count() const { return faces.empty() ? mesh.triangles().size() : faces.size(); }
  /// Of the object's mesh, by Embree's number.
  std::uint32_t face(std::uint32_t primitive) const { return faces.empty() ? primitive : faces[primitive]; }
  /// In world coordinates times the frame's scale: exact, and of a size that products bear.
  FaceCorners corners(std::uint32_t mesh_face) const { return scaled().corners(mesh_face); }
  ScaledMesh scaled() const { return {mesh, scale}; }

  TriangleMesh mesh;
  std::uint32_t object;
  std::vector<std::uint32_t> faces;  ///< ascending; empty: all
  double scale;                      ///< of the frame
  /// How far a face's sides are moved outward (hit_filter.h), and its corners at most; in the frame.
  double grown, farthest;
  /// Where |t|·|N·d| is larger, float knows on which side of the face a point of the ray lies, t away from
  /// the hit (hit_filter.h).
  float clear;
  /// Where w·|N·d| is larger, float knows that a hit with the least barycentric coordinate w lies within the
  /// face.
  float border;
};

/// A device whose errors are exceptions. Throws SystemError, std::bad_alloc.
RTCDevice new_ray_device();

struct RayGroup {
  RayGroup(RTCDevice device, const Scene& scene, const RayPartGroup& parts);
  ~RayGroup();
  RayGroup(const RayGroup&) = delete;
  RayGroup& operator=(const RayGroup&) = delete;

  GroupFrame frame;
  RTCScene scene = nullptr;
  std::vector<std::unique_ptr<RayGeometry>> geometries;  ///< by Embree's number
};

}  // namespace detail

struct RayScene::Impl {
  Impl(const Scene& scene, tbb::task_arena& threads);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RTCDevice device = nullptr;
  /// What hides lights, and the rest of what a camera sees.
  std::vector<std::unique_ptr<detail::RayGroup>> casters, others;
  /// Of each object that casts some of its faces as a group has them, else empty.
  struct OfObject {
    const detail::RayGroup* group = nullptr;
    const detail::RayGeometry* geometry = nullptr;
  };
  std::vector<OfObject> of_object;
  /// Of the object that has a face; empty where there is no such face.
  OfObject of_face(std::int32_t object, std::uint32_t face) const {
    const auto at = static_cast<std::size_t>(object);
    if (object < 0 || at >= of_object.size() || !of_object[at].geometry) return {};
    return face < of_object[at].geometry->mesh.triangles().size() ? of_object[at] : OfObject{};
  }
};

}  // namespace penumbra
