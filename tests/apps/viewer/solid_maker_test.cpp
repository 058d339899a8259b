// Solids in the background, without a window.
#include "apps/viewer/work/solid_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <thread>

#include "penumbra/mesh/shapes.h"
#include "tests/apps/viewer/scenes.h"

namespace penumbra::viewer {
namespace {

void wake_nobody() {}

/// Each detail that is shown, until nothing is under way; at most half a minute.
std::vector<double> details_shown(SolidMaker& maker, const State& state, bool moving = false) {
  std::vector<double> details;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  for (int idle = 0; idle < 3 && std::chrono::steady_clock::now() < end;) {
    const auto solids = maker.update(state, moving);
    if (solids && !maker.outdated(state) && (details.empty() || details.back() != solids->detail))
      details.push_back(solids->detail);
    idle = maker.busy() ? 0 : idle + 1;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return details;
}

State cube() {
  State state = document_of("scenes/cube-medium.json").state();
  state.overlays.umbra_solid = state.overlays.penumbra_solid = true;
  return state;
}

State torus() {
  State state = document_of("scenes/torus-medium.json").state();
  state.overlays.penumbra_solid = true;
  return state;
}

TEST(SolidMaker, DetailsBecomeFinerByHalvesDownToWhatIsWanted) {
  for (const double finest : {0.1, 0.06, 0.02, 0.01, 0.003}) {
    const std::vector<double> details = details_down_to(finest);
    EXPECT_EQ(details.front(), finest < 0.1 / 1.4 ? 0.1 : finest);
    EXPECT_EQ(details.back(), finest);
    for (std::size_t i = 1; i < details.size(); ++i) {
      EXPECT_LT(details[i], 0.75 * details[i - 1]);
      EXPECT_GT(details[i], 0.3 * details[i - 1]);
    }
  }
}

TEST(SolidMaker, ComesCoarseFirstThenFinerOnes) {
  SolidMaker maker(wake_nobody);
  State state = torus();
  state.overlays.detail = 0.05;
  EXPECT_EQ(details_shown(maker, state), (std::vector<double>{0.1, 0.05}));
  EXPECT_EQ(details_shown(maker, state), std::vector<double>{0.05}) << "nothing is made again";
  state.overlays.detail = 0.04;
  EXPECT_EQ(details_shown(maker, state), (std::vector<double>{0.05, 0.04})) << "from where it was";
  state.overlays.detail = 0.1;
  EXPECT_EQ(details_shown(maker, state), std::vector<double>{0.04}) << "what is there is fine enough";
  state.overlays.penumbra_solid = false;
  EXPECT_EQ(maker.update(state, false), nullptr);
}

// A cube takes milliseconds, so that it follows a hand.
TEST(SolidMaker, WhileTheLightMovesOnlyTheCoarsestIsMade) {
  SolidMaker maker(wake_nobody);
  State state = cube();
  EXPECT_EQ(details_shown(maker, state, true), std::vector<double>{0.1});
  HandledLight light = state.handled();
  light.disk.center.x += 0.5;
  state.set_handled(light);
  EXPECT_TRUE(maker.outdated(state));
  EXPECT_EQ(details_shown(maker, state, true), std::vector<double>{0.1});
  EXPECT_FALSE(maker.outdated(state));
}

// Detail 0.3% of a torus takes many seconds.
TEST(SolidMaker, GivesUpWhatIsUnderWayForAnotherLight) {
  SolidMaker maker(wake_nobody);
  State state = torus();
  state.overlays.detail = kFinest;
  const auto shown_detail = [&] {
    const auto solids = maker.update(state, false);
    return solids && !maker.outdated(state) ? solids->detail : 1.0;
  };
  while (shown_detail() > 0.1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  HandledLight light = state.handled();
  light.disk.center.x += 0.5;
  state.set_handled(light);
  state.overlays.detail = 0.1;
  const auto start = std::chrono::steady_clock::now();
  const std::vector<double> details = details_shown(maker, state);
  EXPECT_EQ(details, std::vector<double>{0.1});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(SolidMaker, AnUmbraLiesInThePenumbrasBoxAndSaysWhenThereIsNone) {
  SolidMaker maker(wake_nobody);
  State state = cube();
  state.overlays.detail = 0.1;
  ASSERT_FALSE(details_shown(maker, state).empty());
  auto solids = maker.update(state, false);
  ASSERT_TRUE(solids && solids->umbra && solids->penumbra);
  EXPECT_EQ(solids->trouble, "");
  const auto low = [](const std::vector<SolidVertex>& list) {
    return std::ranges::min(list, {}, &SolidVertex::x).x;
  };
  ASSERT_FALSE(solids->umbra->empty());
  EXPECT_LT(low(*solids->penumbra), low(*solids->umbra));
  DiskLight below = state.handled().disk;
  below.center.y = -below.center.y - 10.0;
  below.normal = {0, -1, 0};
  state.set_handled(below);  // it shines away from everything
  details_shown(maker, state);
  solids = maker.update(state, false);
  ASSERT_TRUE(solids);
  EXPECT_TRUE(!solids->trouble.empty() || solids->umbra->empty()) << solids->umbra->size();
}

TEST(SolidTriangles, AreSmoothButForSharpEdges) {
  const auto as_solid = [](const TriangleMesh& mesh) {
    ShadowMesh out;
    out.positions.assign(mesh.positions().begin(), mesh.positions().end());
    out.triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
    return solid_triangles(out, Vec3(0.0));
  };
  for (const SolidVertex& v : as_solid(make_box({0, 0, 0}, {1, 1, 1})))
    EXPECT_NEAR(std::max({std::abs(v.nx), std::abs(v.ny), std::abs(v.nz)}), 1.0, 1e-6)
        << "a box keeps its edges";
  for (const SolidVertex& v : as_solid(make_icosphere({0, 0, 0}, 1.0, 3)))
    EXPECT_GT(v.nx * v.x + v.ny * v.y + v.nz * v.z, 0.99) << "a sphere is round";
}

}  // namespace
}  // namespace penumbra::viewer
