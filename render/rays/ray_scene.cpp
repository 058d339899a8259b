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

RayScene::Impl::Impl(const Scene& scene, const RayFrame& frame, tbb::task_arena& threads) {
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
  threads.execute([&] {
    rtcCommitScene(all);
    rtcCommitScene(casters);
  });
}

RayScene::Impl::~Impl() {
  rtcReleaseScene(all);
  rtcReleaseScene(casters);
  rtcReleaseDevice(device);
}

RayScene::RayScene(const Scene& scene, detail::Threads threads)
    : frame_(ray_frame(scene)), threads_(std::move(threads)) {
  const auto start = std::chrono::steady_clock::now();
  impl_ = std::make_unique<Impl>(scene, frame_, *threads_);
  build_ms_ = milliseconds_since(start);
}

RayScene::RayScene(const Scene& scene, int threads) : RayScene(scene, detail::make_threads(threads)) {}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

}  // namespace penumbra
