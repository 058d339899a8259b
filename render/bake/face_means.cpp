#include "penumbra/render/bake/face_means.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "penumbra/mesh/error.h"

namespace penumbra {
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

double doubled_area(const TriangleMesh& mesh, std::size_t face) {
  const auto p = mesh.positions();
  const auto& [a, b, c] = mesh.triangles()[face];
  return glm::length(glm::cross(p[b] - p[a], p[c] - p[a]));
}

}  // namespace

FaceMeans::FaceMeans(const BakeSource& source, std::size_t object, const FaceMeansOptions& options)
    : source_(source), object_(object), options_(options) {
  if (object >= source.casters.objects().size())
    throw UsageError("there is no object " + std::to_string(object) + " to bake");
  if (options.side < 1 || options.side > 64) throw UsageError("side must be 1 to 64");
  if (options.part < 1) throw UsageError("a part must have a face");
}

std::size_t FaceMeans::parts() const {
  return (mesh().triangles().size() + options_.part - 1) / options_.part;
}

std::size_t FaceMeans::faces(std::size_t part) const {
  return std::min(options_.part, mesh().triangles().size() - part * options_.part);
}

std::size_t FaceMeans::values(std::size_t part) const {
  return source_.channels() * faces(part) * each();
}

std::vector<float> FaceMeans::bake(std::size_t part, const Progress& progress) const {
  const std::vector<Vec3> places = centers(options_.side);
  const auto object = static_cast<std::uint32_t>(object_);
  // One receiver for each place; with vertices it counts for three targets, so values are found once and
  // weighted here.
  BakeReceivers receivers;
  const std::size_t first = part * options_.part, count = faces(part);
  for (std::size_t i = 0; i < count; ++i) {
    const auto face = static_cast<std::uint32_t>(first + i);
    const Vec3 normal = source_.normal_of(object, face);
    if (normal == Vec3(0.0)) continue;
    for (const Vec3& place : places) receivers.add(mesh(), object, face, place, normal, 0, 1.0);
  }
  for (std::size_t i = 0; i < receivers.size(); ++i) receivers.targets[i] = static_cast<std::uint32_t>(i);
  const std::vector<float> seen = bake_means(source_, receivers, receivers.size(), progress);
  std::vector<float> out(values(part), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t c = 0; c < source_.channels(); ++c)
    for (std::size_t r = 0; r < receivers.size(); r += places.size()) {
      const std::size_t face = receivers.faces[r] - first;
      for (std::size_t corner = 0; corner < each(); ++corner) {
        double sum = 0.0, weights = 0.0;
        for (std::size_t k = 0; k < places.size(); ++k) {
          const double weight = each() == 1 ? 1.0 : places[k][static_cast<int>(corner)];
          sum += weight * seen[c * receivers.size() + r + k];
          weights += weight;
        }
        out[(c * count + face) * each() + corner] = static_cast<float>(sum / weights);
      }
    }
  return out;
}

std::vector<std::vector<float>> FaceMeans::finish(
    const std::function<std::vector<float>(std::size_t part)>& values_of) const {
  const std::size_t faces_in_all = mesh().triangles().size();
  const std::size_t size = each() == 1 ? faces_in_all : mesh().positions().size();
  const std::size_t channels = source_.channels();
  std::vector<std::vector<double>> sums(channels, std::vector<double>(size, 0.0));
  std::vector<double> areas(size, 0.0);
  for (std::size_t part = 0; part < parts(); ++part) {
    const std::vector<float> of_part = values_of(part);
    if (of_part.size() != values(part))
      throw UsageError("part " + std::to_string(part) + " has " + std::to_string(of_part.size()) +
                       " values and should have " + std::to_string(values(part)) + "; it is of another bake");
    const std::size_t count = faces(part);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t corner = 0; corner < each(); ++corner) {
        const std::size_t face = part * options_.part + i;
        const double area = doubled_area(mesh(), face);
        if (std::isnan(of_part[i * each() + corner])) continue;
        const std::size_t target = each() == 1 ? face : mesh().triangles()[face][corner];
        areas[target] += area;
        for (std::size_t c = 0; c < channels; ++c)
          sums[c][target] += area * of_part[(c * count + i) * each() + corner];
      }
  }
  std::vector<std::vector<float>> out(channels);
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t i = 0; i < size; ++i)
      out[c].push_back(areas[i] > 0.0 ? static_cast<float>(sums[c][i] / areas[i])
                                      : std::numeric_limits<float>::quiet_NaN());
  return out;
}

std::vector<std::vector<float>> bake_faces(const BakeSource& source, std::size_t object,
                                           const FaceMeansOptions& options, const Progress& progress) {
  const FaceMeans means(source, object, options);
  const auto count = static_cast<double>(means.parts());
  return means.finish([&](std::size_t part) {
    const auto done = static_cast<double>(part);
    return means.bake(part, part_of(progress, done / count, (done + 1.0) / count));
  });
}

}  // namespace penumbra
