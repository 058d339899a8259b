#include "render/rays/ray_scene.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>

#include "mesh/vectors.h"
#include "render/rays/hit_filter.h"

namespace penumbra {
namespace detail {
namespace {

void throw_embree_error(void*, RTCError error, const char* text) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  const std::string reason = text != nullptr ? text : "unknown error";
  const bool of_threads = reason.find("pthread_create") != std::string::npos;
  throw SystemError("Embree: " + reason +
                    (of_threads ? "; not enough memory for threads, or too many of them" : ""));
}

struct EdgeLengths {
  double longest = 0.0, mean = 0.0;
};
EdgeLengths edge_lengths(const RayGeometry& of) {
  EdgeLengths out;
  const std::size_t count = of.count();
  for (std::size_t i = 0; i < count; ++i) {
    const IndexedTriangle& t = of.mesh.triangles()[of.face(static_cast<std::uint32_t>(i))];
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = glm::distance(of.mesh.positions()[t[k]], of.mesh.positions()[t[(k + 1) % 3]]);
      out.longest = std::max(out.longest, length);
      out.mean += length / (3.0 * static_cast<double>(count));
    }
  }
  return out;
}

GroupFrame frame_of(const Bounds& bounds) {
  const RayFrame frame = frame_around(bounds);
  return {frame.origin, frame.scale, frame.to_local(bounds.low) - kBoxMargin,
          frame.to_local(bounds.high) + kBoxMargin};
}

/// The corner at `p` of a face of which every side moves outward by `by`. The sides at it run to `q` and `r`:
/// it moves along the line that halves their angle, by `by` over the sine of half of it. Not farther than
/// `farthest`, where the angle is small.
Vec3 grown_corner(const Vec3& p, const Vec3& q, const Vec3& r, double by, double farthest) {
  const Vec3 one = unit(q - p), other = unit(r - p);
  const double half_sine = 0.5 * glm::distance(one, other);
  return p - std::min(by / half_sine, farthest) * unit(one + other);
}

/// Three corners a face, in the frame: no two faces share one.
void set_corners(RTCGeometry geometry, const RayGeometry& from, const GroupFrame& frame) {
  const auto triangles = from.mesh.triangles();
  const auto positions = from.mesh.positions();
  const std::size_t count = from.count();
  auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * count));
  auto* faces = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(IndexedTriangle), count));
  const auto set = [&](std::size_t i) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = (positions[triangles[from.face(static_cast<std::uint32_t>(i))][k]] - frame.origin) * frame.scale;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[3 * i + k] =
          glm::vec3(grown_corner(p[k], p[(k + 1) % 3], p[(k + 2) % 3], from.grown, from.farthest));
      faces[3 * i + k] = static_cast<std::uint32_t>(3 * i + k);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) set(i);
  });
}

RTCGeometry make_geometry(RTCDevice device, RayGeometry& from, const GroupFrame& frame) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  set_corners(geometry, from, frame);
  rtcSetGeometryUserData(geometry, &from);
  rtcSetGeometryOccludedFilterFunction(geometry, filter_occluded);
  rtcSetGeometryIntersectFilterFunction(geometry, filter_nearest);
  rtcCommitGeometry(geometry);
  return geometry;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RayGeometry::RayGeometry(const TriangleMesh& mesh_, const RayPart& part, const GroupFrame& frame)
    : mesh(mesh_), object(part.object), faces(part.faces), scale(frame.scale) {
  const EdgeLengths as_given = edge_lengths(*this);
  grown = std::clamp(kGrownOfEdge * as_given.mean * scale, kLeastGrown, kMostGrown);
  farthest = std::max(0.125 * as_given.longest * scale, 4.0 * grown);
  const double longest = as_given.longest * scale + 2.0 * farthest;
  clear = static_cast<float>(kClear * longest * longest);
  border = static_cast<float>(1.75 * (grown + std::max(kLeastGrown, 0.5 * grown)) * longest);
}

RayGroup::RayGroup(RTCDevice device, const Scene& scene_of, const RayPartGroup& group)
    : frame(frame_of(group.bounds)), scene(rtcNewScene(device)) {
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  for (const RayPart& part : group.parts) {
    geometries.push_back(std::make_unique<RayGeometry>(scene_of.objects[part.object].mesh, part, frame));
    RTCGeometry geometry = make_geometry(device, *geometries.back(), frame);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(geometries.size() - 1));
    rtcReleaseGeometry(geometry);
  }
}

RTCDevice new_ray_device() {
  RTCDevice device = rtcNewDevice(nullptr);
  if (!device) {
    const RTCError error = rtcGetDeviceError(nullptr);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw SystemError("Embree does not start: no device (error " + std::to_string(error) + ")");
  }
  rtcSetDeviceErrorFunction(device, throw_embree_error, nullptr);
  return device;
}

RayGroup::~RayGroup() {
  if (scene != nullptr) rtcReleaseScene(scene);
}

}  // namespace detail

RayScene::Impl::Impl(const Scene& scene, tbb::task_arena& threads) {
  device = detail::new_ray_device();
  threads.execute([&] {
    for (const bool casts : {true, false})
      for (const detail::RayPartGroup& group : detail::group_by_scale(scene, casts))
        (casts ? casters : others).push_back(std::make_unique<detail::RayGroup>(device, scene, group));
    of_object.resize(scene.objects.size());
    for (const auto& group : casters)
      for (const auto& geometry : group->geometries)
        of_object[geometry->object] = {group.get(), geometry.get()};
    try {
      for (const auto* groups : {&casters, &others})
        for (const auto& group : *groups) rtcCommitScene(group->scene);
    } catch (...) {
      // To release a scene that could not be committed, for want of memory, waits for ever (Embree 3.13): it
      // is left.
      for (const auto* groups : {&casters, &others})
        for (const auto& group : *groups) group->scene = nullptr;
      throw;
    }
  });
}

RayScene::Impl::~Impl() {
  casters.clear();
  others.clear();
  rtcReleaseDevice(device);
}

RayScene::RayScene(const Scene& scene, detail::Threads threads)
    : frame_(ray_frame(scene)), threads_(std::move(threads)) {
  const auto start = std::chrono::steady_clock::now();
  impl_ = std::make_unique<Impl>(scene, *threads_);
  build_ms_ = detail::milliseconds_since(start);
}

RayScene::RayScene(const Scene& scene, int threads) : RayScene(scene, detail::make_threads(threads)) {}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

}  // namespace penumbra
