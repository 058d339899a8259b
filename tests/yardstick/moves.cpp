#include "tests/yardstick/moves.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "tests/yardstick/judging.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

struct MoveLight {
  const Move& move;

  LightShape operator()(DiskLight light) const {
    light.center = move(light.center);
    light.normal = move.turn * light.normal;
    light.radius *= move.scale;
    return light;
  }
  LightShape operator()(DistantLight light) const {
    light.direction = move.turn * light.direction;
    return light;
  }
  LightShape operator()(RectangleLight light) const {
    light.center = move(light.center);
    light.normal = move.turn * light.normal;
    light.tangent = move.turn * light.tangent;
    light.half_extents *= move.scale;
    return light;
  }
};

struct NamedMove {
  std::string name;
  Move move;
};

std::vector<NamedMove> turns() {
  std::vector<NamedMove> out;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    out.push_back({text("turned_%d", static_cast<int>(seed)), {.turn = turn_by_chance(seed)}});
  return out;
}

/// By chance, the same each time. `size` is what shifts are multiples of.
std::vector<NamedMove> moves(double size) {
  const Vec3 away = glm::normalize(Vec3(0.62, 0.31, -0.72));
  std::vector<NamedMove> out = turns();
  for (const int exponent : {-9, -6, -3, 3, 6, 9})
    out.push_back({text("scaled_1e%d", exponent), {.scale = std::pow(10.0, exponent)}});
  for (const int exponent : {3, 5, 7})
    out.push_back({text("moved_1e%d", exponent), {.shift = std::pow(10.0, exponent) * size * away}});
  out.push_back({"turned_and_scaled_1e-9", {.scale = 1e-9, .turn = turn_by_chance(4)}});
  out.push_back({"turned_and_scaled_1e9", {.scale = 1e9, .turn = turn_by_chance(5)}});
  out.push_back({"turned_and_moved_1e5", {.turn = turn_by_chance(6), .shift = 1e5 * size * away}});
  out.push_back({"turned_and_moved_1e7", {.turn = turn_by_chance(7), .shift = 1e7 * size * away}});
  return out;
}

/// Of pixels that see the same face in both pictures.
struct Change {
  std::size_t pixels = 0, elsewhere = 0, far = 0;
  double most = 0.0;
};
constexpr float kSame = 1e-3f;

Change change_between(const RenderResult& before, const RenderResult& after) {
  Change out;
  const std::vector<float>&v = before.lights.front().visibility, &w = after.lights.front().visibility;
  for (std::size_t i = 0; i < before.surface.size(); ++i) {
    if (before.surface.object[i] != after.surface.object[i] ||
        before.surface.face[i] != after.surface.face[i]) {
      ++out.elsewhere;
      continue;
    }
    if (!before.surface.hit(i)) continue;
    ++out.pixels;
    const float difference = std::abs(v[i] - w[i]);
    out.far += difference > kSame;
    out.most = std::max(out.most, static_cast<double>(difference));
  }
  return out;
}

/// The exact method gives the same V, but for outlines.
void check_sameness(Report& report, const std::string& name, const RenderResult& before,
                    const RenderResult& after) {
  if (!report.wants(name)) return;
  const Change change = change_between(before, after);
  const std::size_t all = change.pixels + change.elsewhere;
  report.add(name, change.pixels > 0 && change.far == 0 && 1000 * change.elsewhere <= all,
             text("%5zu pixels, V differs at %zu, at most %.5f; other faces at %zu", change.pixels,
                  change.far, change.most, change.elsewhere));
}

constexpr PictureSize kSize{160, 120};

std::vector<Contender> contenders_of_moves() {
  std::vector<Contender> out = contenders();
  std::erase_if(out, [](const Contender& c) { return c.method == "rays"; });
  for (Contender& c : out) c.size = kSize;
  // Stratified rays are off by .0022 RMS at 1,024 samples.
  const auto reference = std::ranges::find(out, std::string("reference"), &Contender::method);
  reference->options = {{"samples", std::uint64_t{1'024}}};
  reference->limits = {0.004, 0.05};
  return out;
}

void judge_moves_of(Report& report, const std::string& name, bool only_turned) {
  const Scene scene = scene_named(name);
  JudgedScene base(scene);
  Contender exact = contender("silhouette");
  exact.size = kSize;
  std::optional<RenderResult> before;
  for (const auto& [move_name, move] : only_turned ? turns() : moves(scene.caster_bounds().radius())) {
    const std::string line = "moves/" + name + "_" + move_name;
    if (!report.wants(line)) continue;
    JudgedScene after(moved(scene, move));
    judge_all(report, line, after, &base, contenders_of_moves());
    if (!base.takes(exact)) continue;
    report.attempt(line + "/same", [&] {
      if (!before) before = base.draw(exact);
      check_sameness(report, line + "/same", *before, after.draw(exact));
    });
  }
}

}  // namespace

glm::dquat turn_by_chance(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
}

Scene moved(const Scene& scene, const Move& move) {
  Scene out = scene;
  for (SceneObject& object : out.objects) {
    std::vector<Vec3> points;
    for (const Vec3& p : object.mesh.positions()) points.push_back(move(p));
    object.mesh = TriangleMesh::build(points, object.mesh.triangles(), {.weld = false});
  }
  for (Light& light : out.lights) light.shape = std::visit(MoveLight{move}, light.shape);
  out.camera.eye = move(out.camera.eye);
  out.camera.target = move(out.camera.target);
  out.camera.up = move.turn * out.camera.up;
  return out;
}

void judge_moves(Report& report) {
  for (const char* name : {"ground_2e1", "sheet_1e-2", "sun_distant", "boxes-medium", "bunny-small"})
    judge_moves_of(report, name, false);
  // Not those with a lamp in a wall's plane: after a turn rounding decides on which side of the wall it lies.
  for (const char* name : {"ground_1e4", "ground_1e6", "stray", "sheet_1e-4", "sheet_1e-5", "sun_1e8"})
    judge_moves_of(report, name, true);
}

}  // namespace penumbra::yardstick
