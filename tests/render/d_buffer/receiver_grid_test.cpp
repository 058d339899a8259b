#include "render/d_buffer/entries/receiver_grid.h"

#include <gtest/gtest.h>

#include "render/d_buffer/d_buffer.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;
using testing::Values;
using testing::View;

struct PlacedReceivers {
  std::vector<glm::vec4> positions, planes;
  std::vector<float> seen;
  detail::ImageReceivers image() const { return {static_cast<int>(positions.size()), 1, positions, planes}; }
};

/// In light space, some of them outside of the window, some turned away from the light's center.
PlacedReceivers random_receivers(Random& random, int count) {
  PlacedReceivers out;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 p(1.2 * random.point().x, 1.2 * random.point().y, random.spread(0.1, 2.0));
    const double present = random.uniform(0, 1);
    out.positions.emplace_back(p, present < 0.9 ? 1.0f : present < 0.95 ? 0.0f : -1.0f);
    out.planes.emplace_back(glm::vec3(random.direction()), 0.0f);
    out.seen.push_back(random.uniform(0, 1) < 0.5 ? 0.0f : 1.0f);
  }
  return out;
}

TEST(ReceiverGrid, IsNeverAboveAReceiverInTheBounds) {
  Random random(11);
  const detail::Target target{glm::dmat3(1.0), {-1.0, 1.0, -1.0, 1.0}};
  for (int round = 0; round < 40; ++round) {
    const PlacedReceivers r = random_receivers(random, 1 + round * 5);
    const detail::ReceiverGrid grid(r.image(), r.seen, target, 512);
    for (int query = 0; query < 50; ++query) {
      const glm::dvec2 corner(random.point()), size(random.spread(1e-3, 2.0), random.spread(1e-3, 2.0));
      const detail::UvBounds bounds{corner, corner + size};
      for (const SupportKind kind : {SupportKind::kPenumbra, SupportKind::kUmbra}) {
        const double least = grid.least_height(kind, bounds);
        for (std::size_t i = 0; i < r.positions.size(); ++i) {
          const glm::dvec3 p(r.positions[i]);
          const glm::dvec2 uv(p);
          const bool inside = glm::all(glm::greaterThanEqual(uv, bounds.low)) &&
                              glm::all(glm::lessThanEqual(uv, bounds.high)) &&
                              glm::all(glm::lessThan(glm::abs(uv), glm::dvec2(1.0)));
          const bool hidden = r.seen[i] < 0.5f;
          if (!(r.positions[i].w > 0.0f) || !inside || hidden != (kind == SupportKind::kUmbra)) continue;
          EXPECT_LE(least, p.z) << "receiver " << i;
        }
      }
    }
  }
}

TEST(ReceiverGrid, KnowsWhereNobodyIs) {
  const detail::Target target{glm::dmat3(1.0), {-1.0, 1.0, -1.0, 1.0}};
  const PlacedReceivers one{{{0.5f, 0.5f, 1.0f, 1.0f}}, {{0.0f, 0.0f, 1.0f, 0.0f}}, {1.0f}};
  const detail::ReceiverGrid grid(one.image(), one.seen, target, 512);
  const detail::UvBounds near{{0.45, 0.45}, {0.55, 0.55}}, far{{-0.9, -0.9}, {-0.5, -0.5}};
  EXPECT_LT(grid.least_height(SupportKind::kPenumbra, near), 1.0);
  EXPECT_GT(grid.least_height(SupportKind::kPenumbra, near), 0.8);
  EXPECT_EQ(grid.least_height(SupportKind::kUmbra, near), detail::ReceiverGrid::kNone);
  EXPECT_EQ(grid.least_height(SupportKind::kPenumbra, far), detail::ReceiverGrid::kNone);
  EXPECT_EQ(detail::ReceiverGrid().least_height(SupportKind::kUmbra, far), -detail::ReceiverGrid::kNone);
}

/// What entries say of a pixel must not hang on which others there are, though entries that no receiver reads
/// are not drawn. Depths of facets that are cut elsewhere round differently, which a few pixels show.
TEST(ReceiverGrid, PixelsDoNotDependOnOtherPixels) {
  for (const char* name : {"cube-medium", "torus-medium", "boxes-medium", "bunny-medium", "knot1-large"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 160, 120);
    const auto context = gl::make_context(gl::Backend::kOsMesa);
    DBuffer buffer(*context, scene, view.rays);
    buffer.set_surface(view.surface.receivers());
    const DBufferOptions options{.size = 512, .check = EntryCheck::kNone};  // which looks at neighbors
    const Values all = buffer.render(testing::light_of(scene), options).visibility;
    SurfaceBuffer few = view.surface;
    Random random(3);
    for (std::int32_t& object : few.object)
      if (random.uniform(0, 1) < 0.9) object = -1;
    buffer.set_surface(few.receivers());
    const Values some = buffer.render(testing::light_of(scene), options).visibility;
    int seen = 0, differ = 0;
    for (std::size_t i = 0; i < few.size(); ++i) {
      if (!few.hit(i) || (all[i] == 1.0f && some[i] == 1.0f)) continue;
      ++seen;
      differ += std::abs(all[i] - some[i]) > 1e-4f;
    }
    std::printf("%-14s %4d darkened pixels, %d differ\n", name, seen, differ);
    EXPECT_GT(seen, 20) << name;
    EXPECT_LE(differ, seen / 50) << name;
  }
}

}  // namespace
}  // namespace penumbra
