// usage: penumbra_judge_points SCENE SAMPLES < POINTS
//
// Each line of POINTS is x y z and how much of the scene's first light that point is said to see. Rays in
// double say what it does see. Prints how many points there are, their RMSE and the largest error, and fails
// where that is above .01. Points off by more than .004 are judged again by 16 times as many rays: so much of
// the error is that of the samples (tests/oracle/oracle.h).
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <vector>

#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"
#include "tests/render/oracle_support.h"

namespace {

using namespace penumbra;

constexpr double kMost = 0.01, kAgain = 0.004;

struct Claim {
  Vec3 point;
  double seen;
};

std::vector<Claim> read_claims() {
  std::vector<Claim> claims;
  for (Claim c; std::cin >> c.point.x >> c.point.y >> c.point.z >> c.seen;) claims.push_back(c);
  if (claims.empty() || !std::cin.eof()) throw UsageError("lines of four numbers are wanted");
  return claims;
}

int judge(const std::string& scene_path, int samples) {
  const Scene scene = load_scene(scene_path).scene;
  const oracle::Light light = testing::oracle_light(scene.lights.at(0).shape);
  const std::vector<TriangleMesh> casters = testing::casting_meshes(scene);
  const oracle::Oracle oracle(casters);
  const std::vector<Claim> claims = read_claims();
  std::vector<double> errors(claims.size());
  tbb::parallel_for(std::size_t{0}, claims.size(), [&](std::size_t i) {
    const auto error = [&](int rays) {
      return std::abs(oracle.unoccluded(claims[i].point, {}, light, rays, i) - claims[i].seen);
    };
    errors[i] = error(samples);
    if (errors[i] > kAgain) errors[i] = error(16 * samples);
  });
  double squares = 0.0;
  for (const double e : errors) squares += e * e;
  const auto worst = std::ranges::max_element(errors);
  const Claim& c = claims[static_cast<std::size_t>(worst - errors.begin())];
  std::printf("%zu points, RMSE %.2g, at most %.2g (at %.9g %.9g %.9g, said to see %.6g)\n", claims.size(),
              std::sqrt(squares / static_cast<double>(claims.size())), *worst, c.point.x, c.point.y,
              c.point.z, c.seen);
  return *worst <= kMost ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw UsageError("usage: penumbra_judge_points SCENE SAMPLES < POINTS");
    return judge(argv[1], std::atoi(argv[2]));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "penumbra_judge_points: %s\n", e.what());
    return 2;
  }
}
