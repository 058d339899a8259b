#include "apps/cli/bake/bake.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace penumbra::apps {
namespace {

/// Barycentric coordinates of the centers of side² triangles.
std::vector<Vec3> centers(int side) {
  std::vector<Vec3> out;
  const double step = 1.0 / side;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side - i; ++j) {
      const auto add = [&](double third) {
        const double a = (i + third) * step, b = (j + third) * step;
        out.emplace_back(a, b, 1.0 - a - b);
      };
      add(1.0 / 3.0);
      if (i + j < side - 1) add(2.0 / 3.0);  // the triangle that points the other way
    }
  return out;
}

/// Receivers on all faces that have an area, as many on each.
struct OnFaces {
  OnFaces(const Surface& surface, const std::vector<Vec3>& places) {
    const auto& p = surface.positions;
    for (std::uint32_t f = 0; f < surface.triangles.size(); ++f) {
      const IndexedTriangle& t = surface.triangles[f];
      const Vec3 n = surface.cross(f);
      if (!(glm::length(n) > 0.0)) continue;
      areas.push_back(0.5 * glm::length(n));
      of.push_back(f);
      for (const Vec3& b : places) {
        points.push_back(b.x * p[t[0]] + b.y * p[t[1]] + b.z * p[t[2]]);
        normals.push_back(glm::normalize(n));
        objects.push_back(surface.objects[f]);
        faces.push_back(surface.faces[f]);
      }
    }
  }
  Receivers receivers() const {
    return {.points = points, .normals = normals, .objects = objects, .faces = faces};
  }

  std::vector<double> areas;      ///< one a face that is looked at
  std::vector<std::uint32_t> of;  ///< its number
  std::vector<Vec3> points, normals;
  std::vector<std::int32_t> objects;
  std::vector<std::uint32_t> faces;
};

/// Sums of values and weights.
struct Means {
  explicit Means(std::size_t count) : sums(count, 0.0), weights(count, 0.0) {}
  void add(std::size_t i, double value, double weight) {
    sums[i] += weight * value;
    weights[i] += weight;
  }
  std::vector<float> take() const {
    std::vector<float> out;
    for (std::size_t i = 0; i < sums.size(); ++i)
      out.push_back(weights[i] > 0.0 ? static_cast<float>(sums[i] / weights[i])
                                     : std::numeric_limits<float>::quiet_NaN());
    return out;
  }
  std::vector<double> sums, weights;
};

}  // namespace

std::vector<float> bake(const Casters& casters, const Surface& surface, const LightShape& light,
                        const BakeOptions& options) {
  const std::vector<Vec3> places = centers(options.side);
  const OnFaces on(surface, places);
  const std::vector<float> seen = visibility(casters, light, on.receivers(), options.visibility).visibility;
  Means means(options.vertices ? surface.positions.size() : surface.triangles.size());
  for (std::size_t i = 0; i < on.of.size(); ++i)
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double value = seen[i * places.size() + k];
      if (!options.vertices) {
        means.add(on.of[i], value, 1.0);
        continue;
      }
      const IndexedTriangle& t = surface.triangles[on.of[i]];
      for (int corner = 0; corner < 3; ++corner)
        means.add(t[static_cast<std::size_t>(corner)], value, on.areas[i] * places[k][corner]);
    }
  return means.take();
}

}  // namespace penumbra::apps
