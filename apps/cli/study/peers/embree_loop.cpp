#include "apps/cli/study/peers/embree_loop.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <numbers>
#include <random>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/stage_clock.h"
#include "render/rays/ray_methods.h"
#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"

namespace penumbra::apps {
namespace {

using DeviceOwner = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using SceneOwner = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;

void attach(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions().size()));
  for (const Vec3& p : mesh.positions())
    for (const double value : {p.x, p.y, p.z}) *positions++ = static_cast<float>(value);
  auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles().size()));
  for (const IndexedTriangle& t : mesh.triangles())
    for (const auto corner : t) *corners++ = static_cast<unsigned>(corner);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

/// Points of a disk light, or the directions of a distant one.
class Sampler {
 public:
  explicit Sampler(const LightShape& light) : light_(light) {
    const auto* disk = std::get_if<DiskLight>(&light_);
    axis_ = glm::normalize(disk ? disk->normal : std::get<DistantLight>(light_).direction);
    u_ = glm::normalize(glm::cross(axis_, std::abs(axis_.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    v_ = glm::cross(axis_, u_);
  }
  /// From `from` to the light at (x, y) of the unit disk; a distant light is 1 away.
  Vec3 towards(const Vec3& from, double x, double y) const {
    if (const auto* disk = std::get_if<DiskLight>(&light_))
      return disk->center + disk->radius * (x * u_ + y * v_) - from;
    const double half = std::get<DistantLight>(light_).angle_degrees / 360.0 * std::numbers::pi;
    return -axis_ + std::tan(half) * (x * u_ + y * v_);
  }
  bool is_distant() const { return std::holds_alternative<DistantLight>(light_); }
  const Vec3& axis() const { return axis_; }

 private:
  const LightShape& light_;
  Vec3 axis_{}, u_{}, v_{};
};

class EmbreeLoop : public Method {
 public:
  explicit EmbreeLoop(const Scene& objects)
      : device_(rtcNewDevice(nullptr), rtcReleaseDevice),
        scene_(rtcNewScene(device_.get()), rtcReleaseScene) {
    for (const SceneObject& object : objects.objects)
      if (object.casts) attach(device_.get(), scene_.get(), object.mesh);
    rtcCommitScene(scene_.get());
  }

  MethodResult run(const MethodInput& input) override {
    StageClock clock;
    MethodResult out;
    out.visibility.assign(input.receivers.size(), 1.0f);
    const Sampler light(input.light);
    const ReferenceOptions sampling = sampling_of(input.options);
    const auto near = static_cast<float>(real_of(input.options, "embree-near"));
    input.rays.arena().execute([&] {
      tbb::parallel_for(std::size_t{0}, input.receivers.size(), [&](std::size_t i) {
        if (input.receivers.is_present(i)) out.visibility[i] = see(input.receivers, i, light, sampling, near);
      });
    });
    clock.finish("visibility");
    out.stages = clock.stages();
    out.renderer = "Embree " RTC_VERSION_STRING ", one ray at a time";
    return out;
  }

 private:
  float see(const Receivers& receivers, std::size_t i, const Sampler& light, const ReferenceOptions& sampling,
            float near) const {
    std::minstd_rand random(static_cast<unsigned>(1 + i * 2654435761u + sampling.seed));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int seen = 0;
    for (int k = 0; k < sampling.samples; ++k) {
      const double radius = std::sqrt(uniform(random)), angle = 2.0 * std::numbers::pi * uniform(random);
      const Vec3 way = light.towards(receivers.points[i], radius * std::cos(angle), radius * std::sin(angle));
      const bool above = !receivers.has_normals() || glm::dot(receivers.normals[i], way) > 0.0;
      if (above && glm::dot(light.axis(), way) < 0.0 &&
          !is_hidden(receivers.points[i], way, near, light.is_distant()))
        ++seen;
    }
    return static_cast<float>(seen) / static_cast<float>(sampling.samples);
  }

  bool is_hidden(const Vec3& from, const Vec3& way, float near, bool distant) const {
    const double length = glm::length(way);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x);
    ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(way.x / length);
    ray.dir_y = static_cast<float>(way.y / length);
    ray.dir_z = static_cast<float>(way.z / length);
    ray.tnear = near;
    ray.tfar = distant ? std::numeric_limits<float>::infinity() : static_cast<float>(length);
    ray.mask = ~0u;
    rtcOccluded1(scene_.get(), &context, &ray);
    return ray.tfar < 0.0f;
  }

  DeviceOwner device_;
  SceneOwner scene_;
};

}  // namespace

MethodInfo embree_loop() {
  std::vector<OptionSchema> options = sampling_options();
  options.front().steps = std::vector<OptionValue>{std::uint64_t{1}, std::uint64_t{4}, std::uint64_t{16},
                                                   std::uint64_t{64}, std::uint64_t{256}};
  options.push_back({.name = "embree-near",
                     .domain = RealRange{0.0, 1.0},
                     .usual = 0.001,
                     .unit = "scene units",
                     .help = "Where rays start, against self-shadowing",
                     .steps = std::vector<OptionValue>{}});
  return {.name = "embree-loop",
          .summary = "peer: one ray at a time, Embree as its tutorial has it",
          .takes_distant = true,
          .options = std::move(options),
          .make = [](const Scene& objects) { return std::make_unique<EmbreeLoop>(objects); }};
}

}  // namespace penumbra::apps
