#include "penumbra/render/bake/bake_receivers.h"

#include <algorithm>
#include <limits>

#include "mesh/vectors.h"
#include "render/light/light_integrals.h"

namespace penumbra {
namespace {

/// Irradiance for a radiance of 1 that a receiver gets of a light of which it sees so much.
double seen_irradiance(const AreaLight& light, const Vec3& point, const Vec3& normal, double visibility) {
  const InLightFrame receiver = to_light_frame(light, point, normal);
  const double above = fraction_above_horizon(light, receiver);
  if (!(above > 0.0) || !(visibility > 0.0)) return 0.0;
  return irradiance_factor(light, receiver) * std::min(1.0, visibility / above);
}

/// Sums of values and weights by target.
struct Sums {
  Sums(std::size_t channels, std::size_t count)
      : values(channels * count, 0.0), weights(count, 0.0), targets(count) {}

  void add(std::size_t channel, std::size_t target, double value) {
    values[channel * targets + target] += value;
  }
  std::vector<float> means() const {
    std::vector<float> out(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double weight = weights[i % targets];
      out[i] =
          weight > 0.0 ? static_cast<float>(values[i] / weight) : std::numeric_limits<float>::quiet_NaN();
    }
    return out;
  }

  std::vector<double> values, weights;
  std::size_t targets;
};

}  // namespace

Vec3 face_normal(const TriangleMesh& mesh, std::uint32_t face) {
  const auto p = mesh.positions();
  const auto& [a, b, c] = mesh.triangles()[face];
  const Vec3 u = p[b] - p[a], v = p[c] - p[a];
  return detail::unit(glm::cross(detail::scaled_to_one(u), detail::scaled_to_one(v)));
}

Vec3 BakeSource::normal_of(std::uint32_t object, std::uint32_t face) const {
  const Vec3 normal = face_normal(casters.objects()[object].mesh, face);
  return std::ranges::find(backs, object) == backs.end() ? normal : -normal;
}

void BakeReceivers::add(const TriangleMesh& mesh, std::uint32_t object, std::uint32_t face,
                        const Vec3& barycentric, const Vec3& normal, std::uint32_t target, double weight) {
  const auto p = mesh.positions();
  const auto& [a, b, c] = mesh.triangles()[face];
  points.push_back(barycentric.x * p[a] + barycentric.y * p[b] + barycentric.z * p[c]);
  normals.push_back(normal);
  objects.push_back(static_cast<std::int32_t>(object));
  faces.push_back(face);
  targets.push_back(target);
  weights.push_back(weight);
}

std::vector<float> bake_means(const BakeSource& source, const BakeReceivers& receivers, std::size_t targets,
                              const Progress& progress) {
  Sums sums(source.channels(), targets);
  for (std::size_t i = 0; i < receivers.size(); ++i)
    sums.weights[receivers.targets[i]] += receivers.weights[i];
  if (receivers.size() == 0) return sums.means();
  std::vector<LightShape> shapes;
  for (const Light& light : source.lights) shapes.push_back(light.shape);
  VisibilityOptions options = source.visibility;
  options.progress = progress;
  const std::vector<MethodResult> seen = visibility(source.casters, shapes, receivers.receivers(), options);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const AreaLight light = area_light(shapes[k]);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const double value = seen[k].visibility[i], weight = receivers.weights[i];
      if (source.quantity == BakeQuantity::kVisibility) {
        sums.add(k, receivers.targets[i], weight * value);
        continue;
      }
      const double factor = seen_irradiance(light, receivers.points[i], receivers.normals[i], value);
      for (int c = 0; c < 3; ++c)
        sums.add(static_cast<std::size_t>(c), receivers.targets[i],
                 weight * factor * source.lights[k].radiance[c]);
    }
  }
  return sums.means();
}

}  // namespace penumbra
