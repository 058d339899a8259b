#include "apps/cli/compare/judge.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>
#include <random>

namespace penumbra::apps {
namespace {

constexpr std::uint64_t kChoice = 0xd1b54a32d192ed03;  // of the pixels: the same for every picture

std::vector<TriangleMesh> casters_of(const Scene& scene) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : scene.objects)
    if (object.casts) meshes.push_back(object.mesh);
  return meshes;
}

std::vector<TriangleMesh> all_meshes(const Scene& scene) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : scene.objects) meshes.push_back(object.mesh);
  return meshes;
}

Vec3 unit(const Vec3& v) {
  return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

struct ToOracle {
  oracle::Light operator()(const DiskLight& light) const { return light; }
  oracle::Light operator()(const DistantLight& light) const { return light; }
  oracle::Light operator()(const RectangleLight& light) const {
    const Vec3 m = unit(light.normal), t = unit(light.tangent);
    const Vec3 along = unit(t - glm::dot(t, m) * m);
    return oracle::Rectangle{light.center, light.half_extents.x * along,
                             light.half_extents.y * glm::cross(m, along)};
  }
};

// Calls `value` for every index below count on all cores; reports.
template <class Value>
std::vector<float> in_parallel(std::size_t count, const Progress& progress, const Value& value) {
  std::vector<float> out(count);
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stop{false};
  std::mutex reporting;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    if (stop) return;
    out[k] = static_cast<float>(value(k));
    ++done;
    if (!progress) return;
    const std::unique_lock lock(reporting, std::try_to_lock);
    if (lock && !progress(static_cast<double>(done) / static_cast<double>(count))) stop = true;
  });
  if (stop) throw Cancelled();
  return out;
}

// Each pixel has a seed of its own, so that errors of neighbors do not add up.
std::uint64_t seed_of(std::uint64_t seed, std::uint32_t pixel) {
  return seed + 0x9e3779b97f4a7c15 * (pixel + std::uint64_t{1});
}

// The direction through a pixel's center: the picture is 2 tan(fov/2) high at distance 1, pixels are square.
class Pinhole {
 public:
  Pinhole(const Camera& camera, int width, int height) : width_(width), height_(height) {
    forward_ = unit(camera.target - camera.eye);
    right_ = unit(glm::cross(forward_, unit(camera.up)));
    up_ = glm::cross(right_, forward_);
    pixel_ = 2.0 * std::tan(camera.fov_y_degrees / 360.0 * std::numbers::pi) / height;
  }
  Vec3 direction(std::size_t i) const {
    const auto width = static_cast<std::size_t>(width_);
    const double column = static_cast<double>(i % width), row = static_cast<double>(i / width);
    return forward_ + pixel_ * ((column + 0.5 - 0.5 * width_) * right_ + (0.5 * height_ - row - 0.5) * up_);
  }

 private:
  int width_, height_;
  Vec3 forward_, right_, up_;
  double pixel_;
};

// Moves p into the plane of a face by what rounding has left between them. From the corner that is nearest,
// so that large faces cost no digits.
Vec3 in_plane(const Vec3& p, const std::array<Vec3, 3>& corners, const Vec3& normal) {
  const auto nearest =
      *std::ranges::min_element(corners, {}, [&](const Vec3& c) { return glm::dot(p - c, p - c); });
  return p - glm::dot(p - nearest, normal) * normal;
}

}  // namespace

SurfaceBuffer surface_by_oracle(const Scene& scene, int width, int height) {
  const std::vector<TriangleMesh> meshes = all_meshes(scene);
  const oracle::Oracle oracle(meshes);
  const Pinhole pinhole(scene.camera, width, height);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  SurfaceBuffer out{width, height, {}, {}, {}, {}, 0};
  out.object.assign(pixels, -1);
  out.face.assign(pixels, 0);
  out.position.assign(pixels, Vec3(0.0));
  out.normal.assign(pixels, Vec3(0.0));
  tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t i) {
    const Vec3 direction = pinhole.direction(i);
    const auto hit = oracle.first_hit(scene.camera.eye, direction);
    if (!hit) return;
    const TriangleMesh& mesh = meshes[hit->face.object];
    const IndexedTriangle& t = mesh.triangles()[index(hit->face.face)];
    const std::array<Vec3, 3> corners{mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]};
    const Vec3 normal = unit(glm::cross(unit(corners[1] - corners[0]), unit(corners[2] - corners[0])));
    out.object[i] = static_cast<std::int32_t>(hit->face.object);
    out.face[i] = static_cast<std::uint32_t>(index(hit->face.face));
    out.position[i] = in_plane(scene.camera.eye + hit->distance * direction, corners, normal);
    out.normal[i] = glm::dot(normal, direction) < 0.0 ? normal : -normal;
  });
  return out;
}

Judge::Judge(const Scene& scene, const LightShape& light)
    : light_(std::visit(ToOracle{}, light)), oracle_(casters_of(scene)) {
  std::int32_t casters = 0;
  for (const SceneObject& object : scene.objects) caster_of_.push_back(object.casts ? casters++ : -1);
}

std::optional<oracle::CasterFace> Judge::own_face(const SurfaceBuffer& surface, std::uint32_t pixel) const {
  const std::int32_t caster = caster_of_[static_cast<std::size_t>(surface.object[pixel])];
  if (caster < 0) return {};
  return oracle::CasterFace{static_cast<std::uint32_t>(caster), FaceId{surface.face[pixel]}};
}

std::vector<float> Judge::visibility(const SurfaceBuffer& surface, std::span<const std::uint32_t> pixels,
                                     int samples, std::uint64_t seed, const Progress& progress) const {
  return in_parallel(pixels.size(), progress, [&](std::size_t k) {
    const std::uint32_t i = pixels[k];
    return oracle_.visibility(surface.position[i], surface.normal[i], own_face(surface, i), light_, samples,
                              seed_of(seed, i));
  });
}

std::vector<float> Judge::unoccluded(const SurfaceBuffer& surface, std::span<const std::uint32_t> pixels,
                                     int samples, std::uint64_t seed, const Progress& progress) const {
  return in_parallel(pixels.size(), progress, [&](std::size_t k) {
    const std::uint32_t i = pixels[k];
    const auto own = own_face(surface, i);
    return oracle_.unoccluded(surface.position[i],
                              own ? std::span(&*own, 1) : std::span<const oracle::CasterFace>(), light_,
                              samples, seed_of(seed, i));
  });
}

std::vector<std::uint32_t> Judge::contradicted(const SurfaceBuffer& surface,
                                               std::span<const std::uint32_t> pixels,
                                               std::span<const float> region, int samples, std::uint64_t seed,
                                               const Progress& progress) const {
  std::vector<std::uint32_t> certified, wrong;
  std::ranges::copy_if(pixels, std::back_inserter(certified),
                       [&](std::uint32_t i) { return region[i] == 0.0f || region[i] == 2.0f; });
  const std::vector<float> open = unoccluded(surface, certified, samples, seed, progress);
  for (std::size_t k = 0; k < certified.size(); ++k)
    if (open[k] != (region[certified[k]] == 0.0f ? 1.0f : 0.0f)) wrong.push_back(certified[k]);
  return wrong;
}

std::vector<std::uint32_t> some_of(std::vector<std::uint32_t> pixels, std::size_t count) {
  if (pixels.size() <= count) return pixels;
  std::mt19937_64 random(kChoice);
  for (std::size_t k = 0; k < count; ++k) std::swap(pixels[k], pixels[k + random() % (pixels.size() - k)]);
  pixels.resize(count);
  std::sort(pixels.begin(), pixels.end());
  return pixels;
}

}  // namespace penumbra::apps
