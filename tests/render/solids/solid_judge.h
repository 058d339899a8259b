// Solids judged point by point: is a point inside, by exact signs, and what does it see, by the oracle.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "penumbra/render/solids/extrude_solid.h"
#include "tests/oracle/oracle.h"
#include "volumes/solids/shafts/caster_tree.h"

namespace penumbra {

/// A closed surface that points are asked about.
class SolidInside {
 public:
  explicit SolidInside(const ShadowMesh& mesh)
      : mesh_(TriangleMesh::build(mesh.positions, mesh.triangles, {.weld = false, .flip_inside_out = false})),
        tree_(std::span(&mesh_, 1), CircularLight(DistantLight{})) {}

  /// By the signed crossings of a segment that ends outside.
  bool contains(const Vec3& x) const {
    std::vector<detail::Crossing> found;
    const double far = 4.0 * (mesh_.bounds().radius() + glm::length(x - mesh_.bounds().center()));
    for (int k = 0;; ++k) {
      bool clean = true;
      tree_.crossings(x, x + far * Vec3(0.3 + 0.01 * k, 0.9, 0.2 - 0.03 * k), found, clean);
      if (!clean) continue;
      int sum = 0;
      for (const detail::Crossing& c : found) sum += c.sign;
      return sum != 0;
    }
  }

 private:
  TriangleMesh mesh_;
  detail::CasterTree tree_;
};

struct SolidFigures {
  std::size_t points = 0;
  /// Umbra: inside though some of the light is seen. Penumbra: outside though some is hidden.
  std::size_t wrong = 0;
  std::optional<Vec3> example;
  double worst = 0.0;  ///< fraction of the light
  /// Of the points that are not near the surface: in the region, and of these (umbra) not inside, or
  /// (penumbra) inside without being in the region.
  std::size_t region = 0, missed = 0, surplus = 0;
};

struct SolidPoints {
  std::size_t count = 0;  ///< half of them in the box, half near the surface
  Bounds box;
  double near = 0.0;
  int samples = 256;  ///< rays a point
  std::uint64_t seed = 1;
};

inline std::vector<Vec3> points_for(const ShadowMesh& mesh, const SolidPoints& options) {
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> areas;
  for (const IndexedTriangle& t : mesh.triangles)
    areas.push_back(glm::length(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                           mesh.positions[t[2]] - mesh.positions[t[0]])));
  std::discrete_distribution<std::size_t> pick(areas.begin(), areas.end());
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < options.count; ++i) {
    Vec3 p;
    if (i < options.count / 2 || mesh.triangles.empty()) {
      for (int k = 0; k < 3; ++k)
        p[k] = options.box.low[k] + unit(random) * (options.box.high[k] - options.box.low[k]);
    } else {
      const IndexedTriangle& t = mesh.triangles[pick(random)];
      const double s = std::sqrt(unit(random)), u = unit(random);
      p = (1.0 - s) * mesh.positions[t[0]] + s * (1.0 - u) * mesh.positions[t[1]] +
          s * u * mesh.positions[t[2]];
      const double scale = options.near * std::pow(10.0, -3.0 * unit(random));
      p += scale * Vec3(2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0);
    }
    points.push_back(p);
  }
  return points;
}

/// `umbra`: else it is a penumbra. Points behind the light or outside of the box are left out.
inline SolidFigures judge_solid(const ShadowMesh& mesh, bool umbra, const oracle::Oracle& oracle,
                                const oracle::Light& light, const CircularLight& circular,
                                const SolidPoints& options) {
  const std::vector<Vec3> points = points_for(mesh, options);
  const SolidInside solid(mesh);
  struct Answer {
    bool asked = false, inside = false;
    double seen = 0.0;
  };
  std::vector<Answer> answers(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const Vec3& p = points[i];
    for (int k = 0; k < 3; ++k)
      if (!(options.box.low[k] < p[k] && p[k] < options.box.high[k])) return;
    if (is_behind(circular, p)) return;
    // Few rays tell most points in penumbra.
    const int few = std::min(16, options.samples);
    double seen = oracle.unoccluded(p, {}, light, few, options.seed + i);
    if (seen == (umbra ? 0.0 : 1.0) && few < options.samples)
      seen = oracle.unoccluded(p, {}, light, options.samples, options.seed + i);
    answers[i] = {true, !mesh.triangles.empty() && solid.contains(p), seen};
  });
  SolidFigures out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Answer& a = answers[i];
    if (!a.asked) continue;
    ++out.points;
    const bool in_region = umbra ? a.seen == 0.0 : a.seen < 1.0;
    const bool wrong = umbra ? a.inside && !in_region : !a.inside && in_region;
    if (wrong) {
      ++out.wrong;
      const double by = umbra ? a.seen : 1.0 - a.seen;
      if (by > out.worst) {
        out.worst = by;
        out.example = points[i];
      }
    }
    if (i >= options.count / 2) continue;
    out.region += in_region ? 1 : 0;
    out.missed += in_region && !a.inside ? 1 : 0;
    out.surplus += !in_region && a.inside ? 1 : 0;
  }
  return out;
}

}  // namespace penumbra
