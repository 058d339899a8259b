#include "render/rays/glass/glass_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "mesh/corner_normals.h"
#include "mesh/vectors.h"
#include "render/rays/ray_scene_impl.h"
#include "render/scene/ray_frame.h"

namespace penumbra {
namespace {

// Crossings of one body, in one sense, nearer to each other than this share of the distance are one.
constexpr double kSameCrossing = 4e-6;

constexpr double kSameSurface = 0.82;  // cosine of 35 degrees

RayFrame frame_of(std::span<const GlassBody> bodies) {
  Bounds all;
  for (const GlassBody& body : bodies)
    for (const Vec3& p : body.mesh.positions()) all.add(p);
  return frame_around(all);
}

/// What the filter gathers, behind Embree's context.
struct Query : RTCIntersectContext {
  Vec3 direction;
  const std::vector<std::vector<std::array<Vec3, 3>>>* normals;
  std::vector<GlassCrossing>* out;
};

/// Takes every hit, and lets the ray go on.
void take_hit(const RTCFilterFunctionNArguments* arguments) {
  Query& query = *static_cast<Query*>(arguments->context);
  RTCHit hit = rtcGetHitFromHitN(arguments->hit, 1, 0);
  const auto& n = (*query.normals)[hit.geomID][hit.primID];
  const double u = hit.u, v = hit.v;
  const Vec3 smooth = detail::unit((1.0 - u - v) * n[0] + u * n[1] + v * n[2]);
  const double along = glm::dot(detail::unit({hit.Ng_x, hit.Ng_y, hit.Ng_z}), query.direction);
  query.out->push_back({.distance = RTCRayN_tfar(arguments->ray, 1, 0),
                        .facing = std::max(std::abs(glm::dot(smooth, query.direction)), std::abs(along)),
                        .body = hit.geomID,
                        .enters = along < 0.0});
  arguments->valid[0] = 0;
}

}  // namespace

struct GlassRays::Impl {
  explicit Impl(std::span<const GlassBody> bodies) : frame(frame_of(bodies)) {
    device = detail::new_ray_device();
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    for (const GlassBody& body : bodies) add(body.mesh);
    rtcCommitScene(scene);
  }
  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void add(const TriangleMesh& mesh);

  RayFrame frame;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::vector<std::array<Vec3, 3>>> normals;  ///< of each body
};

void GlassRays::Impl::add(const TriangleMesh& mesh) {
  const auto positions = mesh.positions();
  const auto triangles = mesh.triangles();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
  auto* faces = static_cast<IndexedTriangle*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(IndexedTriangle), triangles.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) corners[i] = glm::vec3(frame.to_local(positions[i]));
  std::ranges::copy(triangles, faces);
  rtcSetGeometryIntersectFilterFunction(geometry, take_hit);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(normals.size()));
  rtcReleaseGeometry(geometry);
  normals.push_back(detail::corner_normals(positions, triangles, kSameSurface));
}

GlassRays::GlassRays(std::span<const GlassBody> bodies) : impl_(std::make_unique<Impl>(bodies)) {}
GlassRays::~GlassRays() = default;
GlassRays::GlassRays(GlassRays&&) noexcept = default;
GlassRays& GlassRays::operator=(GlassRays&&) noexcept = default;

void GlassRays::find_crossings(const Vec3& origin, const Vec3& direction,
                               std::vector<GlassCrossing>& out) const {
  out.clear();
  // In the frame the ray begins where it comes near, so that float keeps its digits.
  const Vec3 way = detail::unit(direction), from = impl_->frame.to_local(origin);
  const double length = glm::length(direction) * impl_->frame.scale;
  const double skipped = std::max(0.0, -glm::dot(from, way) - 2.0);
  const glm::vec3 start(from + skipped * way), along(way);
  Query query{};
  rtcInitIntersectContext(&query);
  query.direction = way;
  query.normals = &impl_->normals;
  query.out = &out;
  RTCRayHit ray{};
  ray.ray = {.org_x = start.x,
             .org_y = start.y,
             .org_z = start.z,
             .tnear = 0.0f,
             .dir_x = along.x,
             .dir_y = along.y,
             .dir_z = along.z,
             .time = 0.0f,
             .tfar = std::numeric_limits<float>::infinity(),
             .mask = ~0u,
             .id = 0,
             .flags = 0};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &query, &ray);
  for (GlassCrossing& crossing : out) crossing.distance = (crossing.distance + skipped) / length;
  std::ranges::sort(out, {}, &GlassCrossing::distance);
  const auto same = [](const GlassCrossing& a, const GlassCrossing& b) {
    return a.body == b.body && a.enters == b.enters && b.distance - a.distance <= kSameCrossing * b.distance;
  };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
}

}  // namespace penumbra
