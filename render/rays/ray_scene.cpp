#include "render/rays/ray_scene.h"

#include <embree3/rtcore.h>

#include <chrono>
#include <cmath>
#include <cstring>

#include "render/rays/ray_scene_impl.h"

namespace penumbra {
namespace {

void throw_embree_error(void*, RTCError, const char* text) {
  throw SystemError(std::string("Embree: ") + text);
}

RTCGeometry make_geometry(RTCDevice device, const TriangleMesh& mesh, const RayFrame& frame) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions().size()));
  for (const Vec3& p : mesh.positions()) {
    const Vec3 q = frame.to_local(p);
    for (int k = 0; k < 3; ++k) *points++ = static_cast<float>(q[k]);
  }
  void* faces = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        sizeof(IndexedTriangle), mesh.triangles().size());
  std::memcpy(faces, mesh.triangles().data(), mesh.triangles().size_bytes());
  rtcCommitGeometry(geometry);
  return geometry;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RayFrame ray_frame(const Scene& scene) {
  RayFrame frame;
  frame.origin = scene.light.center;
  Bounds bounds = scene.bounds();
  bounds.add(scene.light.center);
  double reach = scene.light.radius;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                 corner & 4 ? bounds.high.z : bounds.low.z};
    const Vec3 d = p - frame.origin;
    for (int k = 0; k < 3; ++k) reach = std::max(reach, std::abs(d[k]));
  }
  if (reach > 0.0) frame.scale = std::exp2(-std::ceil(std::log2(reach)));
  return frame;
}

RayScene::Impl::Impl(const Scene& scene, const RayFrame& frame, int threads)
    : arena(thread_count(threads)), scene_(scene), frame_(frame) {
  device = rtcNewDevice(nullptr);
  if (!device)
    throw SystemError("Embree does not start: no device (error " +
                      std::to_string(rtcGetDeviceError(nullptr)) + ")");
  rtcSetDeviceErrorFunction(device, throw_embree_error, nullptr);
  all = rtcNewScene(device);
  casters = rtcNewScene(device);
  for (RTCScene s : {all, casters}) rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (object.mesh.empty()) continue;
    RTCGeometry geometry = make_geometry(device, object.mesh, frame);
    rtcAttachGeometryByID(all, geometry, static_cast<unsigned>(i));
    if (object.casts) rtcAttachGeometryByID(casters, geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
  arena.execute([&] {
    rtcCommitScene(all);
    rtcCommitScene(casters);
  });
}

RayScene::Impl::~Impl() {
  rtcReleaseScene(all);
  rtcReleaseScene(casters);
  rtcReleaseDevice(device);
}

/// Made once, on the cores of the arena.
template <class T>
const T& RayScene::Impl::once(OnDemand<T>& of) const {
  std::call_once(of.once, [&] {
    const auto start = std::chrono::steady_clock::now();
    const auto make = [&] { of.made = std::make_unique<T>(scene_, frame_.origin, frame_.scale); };
    arena.execute([&] { tbb::this_task_arena::isolate(make); });  // takes no work that may ask for the same
    of.milliseconds = milliseconds_since(start);
  });
  return *of.made;
}

const detail::SceneEdges& RayScene::Impl::edges() const {
  return once(edges_);
}

const detail::MergedEdges& RayScene::Impl::merged_edges() const {
  return once(merged_edges_);
}

RayScene::RayScene(const Scene& scene, int threads) : frame_(ray_frame(scene)) {
  const auto start = std::chrono::steady_clock::now();
  impl_ = std::make_unique<Impl>(scene, frame_, threads);
  build_ms_ = milliseconds_since(start);
}

tbb::task_arena& RayScene::arena() const {
  return impl_->arena;
}

double RayScene::edge_hierarchy_ms() const {
  return impl_->edges_ms();
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

}  // namespace penumbra
