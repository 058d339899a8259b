// What exact classification costs, and what plain arithmetic gets wrong.
#include <tbb/global_control.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/classify.h"
#include "tests/bench/bench_support.h"
#include "tests/volumes/random_inputs.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra::bench {
namespace {

struct Input {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  DiskLight light;
};

/// The formula of classify_face in plain arithmetic of one precision.
template <class T>
FaceClass classify_plain(const glm::vec<3, T>& a, const glm::vec<3, T>& b, const glm::vec<3, T>& c,
                         const glm::vec<3, T>& center, const glm::vec<3, T>& m, T radius) {
  const glm::vec<3, T> n = glm::cross(b - a, c - a);
  const T d = glm::dot(n, center - a);
  const glm::vec<3, T> across = glm::cross(n, m);
  if (!(d * d * glm::dot(m, m) > radius * radius * glm::dot(across, across))) return FaceClass::kMixed;
  return d > T(0) ? FaceClass::kAllFront : FaceClass::kNoneFront;
}

template <class T>
void classify_all_plain(const std::vector<glm::vec<3, T>>& p, const Input& in, std::vector<FaceClass>& out) {
  const glm::vec<3, T> center(in.light.center), m(in.light.normal);
  const T radius = static_cast<T>(in.light.radius);
  for (std::size_t i = 0; i < in.triangles.size(); ++i) {
    const IndexedTriangle& t = in.triangles[i];
    out[i] = classify_plain<T>(p[t[0]], p[t[1]], p[t[2]], center, m, radius);
  }
}

using Classify = FaceClass (*)(const Vec3&, const Vec3&, const Vec3&, const CircularLight&);

void classify_all(Classify classify, const Input& in, std::vector<FaceClass>& out) {
  const CircularLight light = in.light;
  for (std::size_t i = 0; i < in.triangles.size(); ++i) {
    const IndexedTriangle& t = in.triangles[i];
    out[i] = classify(in.positions[t[0]], in.positions[t[1]], in.positions[t[2]], light);
  }
}

/// One of the four ways, with the times of its runs.
struct Way {
  const char* name;
  std::function<void(std::vector<FaceClass>&)> run;
  std::vector<double> nanoseconds{};
  std::vector<FaceClass> classes{};
};

/// Runs take turns, so that what else the machine does hits all ways alike.
void compare(Record& record, const Input& in) {
  constexpr int kRuns = 60;
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const TriangleMesh mesh =
      TriangleMesh::build(in.positions, in.triangles, {.weld = false, .flip_inside_out = false});
  if (mesh.triangles().size() != in.triangles.size()) throw std::logic_error("a face is degenerate");
  std::vector<glm::vec3> singles;
  for (const Vec3& p : in.positions) singles.emplace_back(p);
  std::vector<Way> ways{{"float", [&](auto& out) { classify_all_plain<float>(singles, in, out); }},
                        {"double", [&](auto& out) { classify_all_plain<double>(in.positions, in, out); }},
                        {"filtered", [&](auto& out) { out = classify_faces(mesh, in.light).faces; }},
                        {"exact", [&](auto& out) { classify_all(&detail::exact::classify_face, in, out); }}};
  const auto faces = static_cast<double>(in.triangles.size());
  for (int run = 0; run < kRuns; ++run) {
    for (Way& way : ways) {
      if (&way == &ways.back() && run >= 3) continue;
      way.classes.resize(in.triangles.size());
      const auto start = std::chrono::steady_clock::now();
      way.run(way.classes);
      way.nanoseconds.push_back(
          std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / faces);
    }
  }
  record.add(in.name + "/faces", "1", faces);
  for (const Way& way : ways) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < in.triangles.size(); ++i) wrong += way.classes[i] != ways.back().classes[i];
    record.add(in.name + "/" + way.name, "ns a face", way.nanoseconds);
    record.add(in.name + "/" + way.name + "/wrong", "faces", static_cast<double>(wrong));
  }
  record.add(in.name + "/filtered : double", "1", paired_ratios(ways[2].nanoseconds, ways[1].nanoseconds));
}

Input ordinary(const std::string& name, const TriangleMesh& mesh) {
  return {name,
          {mesh.positions().begin(), mesh.positions().end()},
          {mesh.triangles().begin(), mesh.triangles().end()},
          {{0.3, 4, 0.2}, {0.1, -1, 0.05}, 0.5}};
}

/// One light; faces in planes that touch its rim: exactly (all coordinates are integers), or as nearly as
/// doubles can be (weights of thirds and sevenths).
Input tangent(bool rounded) {
  constexpr int kFaces = 100'000;
  testing::RandomInputs random(7);
  Input in{rounded ? "tangent, rounded" : "tangent, integers", {}, {}, {{0, 0, 0}, {0, 0, 2}, 5.0}};
  while (in.triangles.size() < kFaces) {
    const double sx = random.integer(0, 1) ? 3 : -3, sy = random.integer(0, 1) ? 4 : -4;
    const Vec3 rim(sx, sy, 0), along(-sy, sx, 0);
    const double lean = random.integer(-3, 3);
    const Vec3 across(lean * sx, lean * sy, 25.0 * random.integer(1, 3));
    const auto first = static_cast<std::uint32_t>(in.positions.size());
    for (int k = 0; k < 3; ++k) {
      double u = random.integer(-5, 5), v = random.integer(-4, 4);
      if (rounded) u /= 3.0, v /= 7.0;
      in.positions.push_back(rim + u * along + v * across);
    }
    const Vec3* p = in.positions.data() + first;
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0])
      in.positions.resize(first);
    else
      in.triangles.push_back({first, first + 1, first + 2});
  }
  return in;
}

}  // namespace

void bench_price(Record& record, const SceneNames&) {
  const std::filesystem::path meshes = std::filesystem::path(PENUMBRA_DATA) / "meshes";
  for (const char* name : {"armadillo", "decorativePlant", "refined_elephant"})
    compare(record, ordinary(name, read_mesh(meshes / (std::string(name) + ".ply"))));
  compare(record, ordinary("sphere", make_icosphere({0, 0, 0}, 1.0, 7)));
  compare(record, tangent(false));
  compare(record, tangent(true));
}

}  // namespace penumbra::bench
