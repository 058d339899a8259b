// Casters that are hard to merge, each with a light and receivers that look past what is hard: bumps, pits,
// ridges, creases, steps and noise of every size beside the light's, on plates, balls, rings and bodies of
// 1,000 faces or more, and curled leaves. Made from a seed.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/subdivide.h"

namespace penumbra::testing {

struct AdversarialScene {
  std::string name;
  /// One of Body::kNames or "leaves".
  std::string body;
  Scene scene;
  SurfaceBuffer receivers;
};

/// A height over a surface, as a function of two lengths along it from the middle of the feature.
struct Feature {
  static constexpr std::array<const char*, 10> kNames{"bump",  "pit",   "ridge", "crease", "step",
                                                      "spike", "bumps", "noise", "pimple", "hole"};
  int kind = 0;
  double size = 0.1, height = 0.1, angle = 0.0;

  double at(double u, double v) const {
    const double p = (u * std::cos(angle) + v * std::sin(angle)) / size;
    const double q = (v * std::cos(angle) - u * std::sin(angle)) / size;
    const double d = std::hypot(p, q);
    const auto hump = [](double t) { return t < 1.0 ? 0.5 + 0.5 * std::cos(kPi * t) : 0.0; };
    switch (kind) {
      case 0:
        return height * hump(d);
      case 1:
        return -height * hump(d);
      case 2:
        return height * hump(std::abs(p)) * hump(std::abs(q) / 6.0);
      case 3:
        return height * std::min(std::abs(p), 3.0);
      case 4:
        return height * std::clamp(p, -1.0, 1.0);
      case 5:
        return height * std::max(0.0, 1.0 - d);
      case 6:
        return height * hump(std::hypot(p - 2.5 * std::round(p / 2.5), q - 2.5 * std::round(q / 2.5)));
      case 8:  // one vertex
        return d == 0.0 ? height : 0.0;
      case 9:
        return d == 0.0 ? -height : 0.0;
      default:
        return height *
               (std::sin(p) * std::sin(q + 0.4 * p) + 0.5 * std::sin(2.3 * q) + 0.2 * std::sin(7 * p));
    }
  }
};

/// A surface over [-1, 1]² or round it, displaced by a feature at (0, 0).
struct Body {
  static constexpr std::array<const char*, 5> kNames{"plate", "slab", "ball", "ring", "tube"};
  int kind = 0;
  double bend = 0.0;  ///< of a plate

  bool is_round_u() const { return kind >= 2; }
  bool is_round_v() const { return kind == 3; }
  /// The point, displaced along the normal.
  Vec3 at(double u, double v, double height) const {
    switch (kind) {
      case 0:
        return {u, v, bend * (u * u + 0.7 * v * v) + height};
      case 1:
        return {u, v, height};
      case 2: {
        const double a = kPi * u, b = 0.5 * kPi * v, c = std::abs(v) >= 1.0 ? 0.0 : std::cos(b);
        return (1.0 + height) * Vec3(std::cos(a) * c, std::sin(a) * c, std::sin(b));
      }
      case 3: {
        const double a = kPi * u, b = kPi * v, tube = 0.4 + height;
        return {(0.8 + tube * std::cos(b)) * std::cos(a), (0.8 + tube * std::cos(b)) * std::sin(a),
                tube * std::sin(b)};
      }
      default: {
        const double a = kPi * u;
        return {(0.5 + height) * std::cos(a), (0.5 + height) * std::sin(a), v};
      }
    }
  }
  /// Lengths along the surface in one unit of u.
  double stretch() const { return kind < 2 ? 1.0 : kind == 2 ? kPi : kind == 3 ? 1.2 * kPi : 0.5 * kPi; }
};

/// Numbers from -1 to 1 with 0 among them, evenly or with steps that grow away from 0.
inline std::vector<double> steps_of(int count, double least, bool even) {
  std::vector<double> out;
  const int half = std::max(2, count / 2);
  const double growth = even ? 1e-3 : std::max(0.1, std::log(1.0 / std::min(0.5, least * half)) + 1.0);
  for (int i = -half; i <= half; ++i) {
    const double t = static_cast<double>(std::abs(i)) / half;
    out.push_back(i == 0 ? 0.0 : std::copysign(std::expm1(growth * t) / std::expm1(growth), i));
  }
  return out;
}

/// The faces of a grid; where it is round its last row or column is its first. `flip`: seen from below.
inline void add_grid(int columns, int rows, bool round_u, bool round_v, std::uint32_t first, bool flip,
                     std::vector<IndexedTriangle>& faces) {
  const auto id = [&](int i, int j) {
    if (round_u && i == columns - 1) i = 0;
    if (round_v && j == rows - 1) j = 0;
    return first + static_cast<std::uint32_t>(j * columns + i);
  };
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const std::uint32_t a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      const bool turn = (i + j) % 2 != 0;
      IndexedTriangle p = turn ? IndexedTriangle{a, b, c} : IndexedTriangle{a, b, d};
      IndexedTriangle q = turn ? IndexedTriangle{a, c, d} : IndexedTriangle{b, c, d};
      if (flip) std::swap(p[0], p[1]), std::swap(q[0], q[1]);
      faces.push_back(p);
      faces.push_back(q);
    }
}

inline TriangleMesh make_body(Random& random, const Body& body, const Feature& feature, int faces) {
  const bool even = random.uniform(0, 1) < 0.4;
  const int side = static_cast<int>(std::sqrt(0.5 * faces / (body.kind == 1 ? 2.0 : 1.0)));
  const double least = random.spread(0.15, 1.2) * feature.size / body.stretch();  // down to one vertex
  const std::vector<double> us = steps_of(side, least, even), vs = steps_of(side, least, even);
  const int columns = static_cast<int>(us.size()), rows = static_cast<int>(vs.size());

  std::vector<Vec3> points;
  std::vector<IndexedTriangle> triangles;
  for (const double v : vs)
    for (const double u : us)
      points.push_back(body.at(u, v, feature.at(body.stretch() * u, body.stretch() * v)));
  add_grid(columns, rows, body.is_round_u(), body.is_round_v(), 0, false, triangles);
  if (body.kind == 1) {  // its underside, and the strips round it
    const auto below = static_cast<std::uint32_t>(points.size());
    for (const double v : vs)
      for (const double u : us) points.push_back({u, v, -0.3});
    add_grid(columns, rows, false, false, below, true, triangles);
    const auto strip = [&](std::uint32_t a, std::uint32_t b) {
      triangles.push_back({b, a, below + a});
      triangles.push_back({b, below + a, below + b});
    };
    const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(j * columns + i); };
    for (int i = 0; i + 1 < columns; ++i)
      strip(id(i, 0), id(i + 1, 0)), strip(id(i + 1, rows - 1), id(i, rows - 1));
    for (int j = 0; j + 1 < rows; ++j)
      strip(id(0, j + 1), id(0, j)), strip(id(columns - 1, j), id(columns - 1, j + 1));
  }
  std::erase_if(triangles, [&](const IndexedTriangle& t) {
    return points[t[0]] == points[t[1]] || points[t[1]] == points[t[2]] || points[t[2]] == points[t[0]];
  });

  // Its border runs in and out where it has one, as the feature does.
  if (body.kind == 0 && random.uniform(0, 1) < 0.3)
    for (Vec3& p : points)
      if (p.y == 1.0) p.y += feature.at(p.x, 0.0);
  if (random.uniform(0, 1) < 0.4)
    for (Vec3& p : points) p = Vec3(glm::vec3(p));
  return TriangleMesh::build(points, triangles);
}

/// Leaves of 512 faces that curl.
inline TriangleMesh make_leaves(Random& random, int count, double size) {
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle = 0.8 * random.point(), n = random.direction();
    const Vec3 u = glm::normalize(glm::cross(n, random.direction())), v = glm::cross(n, u);
    const auto first = static_cast<std::uint32_t>(points.size());
    const double curl = random.uniform(-0.3, 0.3);
    for (int y = 0; y <= 16; ++y)
      for (int x = 0; x <= 16; ++x) {
        const double a = (x - 8) / 8.0, b = (y - 8) / 8.0;
        points.push_back(middle +
                         size * (a * u + b * (1 - 0.5 * a * a) * v + curl * (a * a - b * b * b) * n));
      }
    add_grid(17, 17, false, false, first, false, faces);
  }
  return TriangleMesh::build(points, faces);
}

/// Where receivers look, and how: past point `at` of the caster, towards the light in direction `way`.
struct Look {
  Vec3 at, way;
  double light_distance, distance;
};

/// Receivers on grids in planes across the view, as large as the feature and its penumbra, as these both, and
/// as the whole caster; and some on the caster.
inline SurfaceBuffer receivers_past(Random& random, const TriangleMesh& mesh, const Look& look,
                                    const Vec3& light, double small, double large) {
  constexpr int kWidth = 32, kRows = 16;
  std::vector<Vec3> points, normals;
  const Vec3 u = glm::normalize(glm::cross(look.way, random.direction())), v = glm::cross(look.way, u);
  for (const double size : {small, large, 1.5}) {
    const Vec3 shift = 0.5 * size * random.point();
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const Vec3 across =
            size * ((x - 0.5 * kWidth) * 2.0 / kWidth * u + (y - 0.5 * kRows) * 2.0 / kRows * v);
        const Vec3 past = look.at + across + shift - glm::dot(shift, look.way) * look.way;
        points.push_back(light + (past - light) * (1.0 + look.distance / look.light_distance));
        normals.push_back(look.way);
      }
  }
  SurfaceBuffer out = receivers(points, normals, kWidth);
  // On the caster, near the feature and elsewhere.
  for (int i = 0; i < kWidth * kRows; ++i) {
    std::uint32_t face = 0;
    double nearest = 1e30;
    for (int k = 0; k < (i % 2 == 0 ? 64 : 1); ++k) {
      const auto f =
          static_cast<std::uint32_t>(random.uniform(0, 1) * static_cast<double>(mesh.triangles().size()));
      const double d = glm::distance(mesh.positions()[mesh.triangles()[f][0]], look.at);
      if (d < nearest) nearest = d, face = f;
    }
    const auto& [a, b, c] = mesh.triangles()[face];
    const Vec3 p = mesh.positions()[a], e = mesh.positions()[b] - p, f = mesh.positions()[c] - p;
    Vec3 n = glm::cross(e, f);
    n = glm::length(n) > 0.0 ? glm::normalize(n) : look.way;
    out.object.push_back(0), out.face.push_back(face);
    out.position.push_back(p + 0.3 * e + 0.4 * f);
    out.normal.push_back(glm::dot(n, light - p) < 0.0 ? -n : n);
  }
  out.height += kRows;
  return out;
}

inline AdversarialScene adversarial_scene(std::uint64_t seed, int most_faces) {
  Random random(seed);
  const auto any = [&](std::size_t count) {
    return static_cast<int>(random.uniform(0, 1) * static_cast<double>(count));
  };
  const int faces = static_cast<int>(random.spread(1100, most_faces));
  const int kinds[] = {0, 0, 1, 2, 3, 4, 5, 5, 6, 7, 8, 8, 8, 9};
  Feature feature{kinds[any(14)], random.spread(2e-5, 0.3), 0.0, random.uniform(0, 6.28)};
  feature.height = feature.size * random.spread(0.03, 2.0);
  const int bodies[] = {0, 0, 0, 1, 1, 2, 2, 3, 4};
  const Body body{bodies[any(9)], random.uniform(0, 1) < 0.7 ? 0.0 : random.spread(0.003, 0.3)};
  AdversarialScene out;
  const bool leaves = any(12) == 0;
  TriangleMesh mesh = leaves ? make_leaves(random, std::max(3, faces / 512), feature.size + 0.1)
                             : make_body(random, body, feature, faces);

  // Where to look: past the feature or another vertex; along the surface, down on it, or in any way.
  Look look{};
  const bool at_feature = !leaves && any(4) != 0;
  const double at_u = 0.7 * feature.size / body.stretch() * random.uniform(-1, 1);
  const double at_v = 0.7 * feature.size / body.stretch() * random.uniform(-1, 1);
  const auto surface = [&](double u, double v) {
    return body.at(u, v, feature.at(body.stretch() * u, body.stretch() * v));
  };
  look.at = at_feature ? surface(at_u, at_v)
                       : mesh.positions()[static_cast<std::size_t>(any(mesh.positions().size()))];
  const Vec3 du = body.at(1e-4, 0, 0) - body.at(0, 0, 0), dv = body.at(0, 1e-4, 0) - body.at(0, 0, 0);
  const Vec3 normal = glm::normalize(glm::cross(du, dv));
  const Vec3 along = glm::normalize(glm::cross(normal, random.direction()));
  const int view = any(6) - 1;
  const double lift = view <= 1 ? feature.height * random.spread(0.03, 3.0) : random.spread(1e-4, 0.5);
  look.way = view <= 2   ? glm::normalize(along + random.uniform(-1, 1) * lift * normal)
             : view == 3 ? glm::normalize(normal + random.spread(1e-2, 2.0) * along)
                         : random.direction();
  look.light_distance = random.spread(2.6, 8.0), look.distance = random.spread(0.3, 8.0);

  // The light: beside the feature or beside the caster of any size.
  const double seen = any(3) != 0 ? feature.size * random.spread(0.1, 10.0) : random.spread(1e-4, 0.6);
  const Vec3 center = look.at + look.light_distance * look.way;
  const double radius = seen * (look.light_distance + look.distance) / look.distance;
  light_of(out.scene) = {center, glm::normalize(-look.way + 0.1 * random.point()), std::min(radius, 3.0)};
  out.receivers =
      receivers_past(random, mesh, look, center, 0.5 * feature.size + seen, 3.0 * (feature.size + seen));
  out.body = leaves ? "leaves" : Body::kNames[body.kind];
  out.name = std::to_string(seed) + " " + out.body +
             (leaves ? std::string() : std::string(" with ") + Feature::kNames[feature.kind]) + ", " +
             std::to_string(mesh.triangles().size()) + " faces";
  out.scene.objects.push_back({"caster", std::move(mesh), Vec3(0.8), true});
  return out;
}

}  // namespace penumbra::testing
