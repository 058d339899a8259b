#include "tests/bench/plan/cases.h"

#include <glm/geometric.hpp>
#include <sstream>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "tests/bench/plan/random_scenes.h"

namespace penumbra::bench {
namespace {

using Words = std::vector<std::string>;

double number(const Words& words, std::size_t i) {
  return std::stod(words.at(i));
}
int count(const Words& words) {
  return static_cast<int>(number(words, 1));
}

Words split(const std::string& text) {
  Words out;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, '-');) out.push_back(word);
  return out;
}

Scene data_scene(const std::string& name) {
  return load_scene(std::filesystem::path(PENUMBRA_DATA) / "scenes" / (name + ".json")).scene;
}

/// A floor of side 12 under a light at height 4.
Scene over_floor(TriangleMesh caster, double radius) {
  Scene scene;
  scene.camera = {.eye = {3, 3.5, 5}, .target = {0, 0.4, 0}, .fov_y_degrees = 40.0};
  scene.lights.push_back({.shape = DiskLight{{0, 4, 0}, {0, -1, 0}, radius}});
  scene.objects.push_back({.name = "caster", .mesh = std::move(caster)});
  scene.objects.push_back({.name = "floor", .mesh = make_plane(6.0), .casts = false});
  return scene;
}

TriangleMesh fan(int pleats) {
  std::vector<Vec3> points{{0, 0.7, 0}};
  std::vector<IndexedTriangle> faces;
  const auto around = static_cast<std::uint32_t>(2 * pleats);
  for (std::uint32_t i = 0; i < around; ++i) {
    const double angle = 2.0 * kPi * i / around, far = i % 2 ? 1.0 : 0.98;
    points.emplace_back(far * std::cos(angle), i % 2 ? 0.9 : 0.5, far * std::sin(angle));
    faces.push_back({0, i + 1, (i + 1) % around + 1});
  }
  return TriangleMesh::build(points, faces);
}

TriangleMesh wires(int number_of_wires) {
  Random random(7);
  Triangles out;
  for (int i = 0; i < number_of_wires; ++i) {
    const Vec3 from{-3, random.uniform(0.3, 1.5), random.uniform(-3, 3)},
        to{3, random.uniform(0.3, 1.5), random.uniform(-3, 3)};
    out.add(from, to, to + Vec3(0, 0.004, 0.004));
  }
  return out.mesh();
}

}  // namespace

std::vector<std::string> fit_cases() {
  constexpr int kByChance = 60;  // plans are judged on others
  std::vector<std::string> out{"cube-medium",
                               "sphere-medium",
                               "torus-large",
                               "boxes-large",
                               "boxes-sun",
                               "foliage-small",
                               "foliage-medium",
                               "triangle-medium",
                               "bunny-small",
                               "bunny-medium",
                               "knot1-medium",
                               "knot1-large",
                               "armadillo-small",
                               "armadillo-medium",
                               "armadillo-large",
                               "building",
                               "refined_elephant-medium",
                               "decorativePlant-small",
                               "terrain-sun",
                               "decorativePlant-medium",
                               "room",
                               "contact",
                               "figure7",
                               "tree",
                               "soup-200-0.05-0.5",
                               "soup-500-0.05-0.5",
                               "soup-2000-0.05-0.2",
                               "soup-2000-0.05-1",
                               "soup-5000-0.02-0.5",
                               "soup-20000-0.02-0.3",
                               "soup-20000-0.2-0.5",
                               "soup-20000-0.02-1.5",
                               "soup-6000-0.1-3",
                               "soup-20000-0.1-1",
                               "fan-4000-0.5",
                               "fan-300-1"};
  for (int seed = 1; seed <= kByChance; ++seed) out.push_back("random-" + std::to_string(seed));
  return out;
}

std::vector<std::string> foolish_cases() {
  return {"soup-60000-0.05-3",
          "soup-20000-0.2-1",
          "tree",
          "fan-4000-0.5",
          "ball-9-0.5",
          "soup-60000-0.02-0.5",
          "soup-2000-0.3-2",
          "fan-1000-2",
          "wires-2000-0.5",
          "wires-400-2",
          "grass-20000-0.5",
          "balls-1000-1",
          "ball-8-2",
          "wide-4-decorativePlant-medium",
          "wide-3-foliage-medium"};
}

Scene plan_case(const std::string& name) {
  const Words words = split(name);
  const std::string& kind = words.front();
  if (kind == "soup") return over_floor(soup(count(words), number(words, 2)), number(words, 3));
  if (kind == "fan") return over_floor(fan(count(words)), number(words, 2));
  if (kind == "ball") return over_floor(make_icosphere({0, 0.7, 0}, 0.6, count(words)), number(words, 2));
  if (kind == "wires") return over_floor(wires(count(words)), number(words, 2));
  if (kind == "grass") return over_floor(grass(count(words), 2.0, 11), number(words, 2));
  if (kind == "balls") return over_floor(balls(count(words)), number(words, 2));
  if (kind == "random") return random_scene(static_cast<std::uint64_t>(count(words)));
  if (kind != "wide") return data_scene(name);
  Scene scene = data_scene(name.substr(kind.size() + words.at(1).size() + 2));
  std::get<DiskLight>(scene.lights.front().shape).radius *= number(words, 1);
  return scene;
}

}  // namespace penumbra::bench
