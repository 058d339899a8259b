// The D-buffer over scenes by chance: no leak, speck, seam or acne. Ten scenes; a hundred with PENUMBRA_LONG set.
#include <gtest/gtest.h>

#include <cstdlib>

#include "render/shading.h"
#include "tests/render/random_poses.h"

namespace penumbra {
namespace {

using testing::Pixels;
using testing::Values;
using testing::View;

constexpr int kWidth = 160, kHeight = 120;
constexpr std::array kMeshes{"scenes/cube.off", "meshes/bunny.ply", "meshes/knot1.ply", "meshes/armadillo.ply",
                             "meshes/fandisk.ply"};

struct Tally {
  std::size_t penumbra = 0;      ///< pixels in true penumbra
  std::size_t far_off = 0;       ///< of these, more than .5 from the reference
  std::size_t outside = 0;       ///< more than .5 off and not within two pixels of the penumbra
};

/// Pixels within `steps` of a marked one.
std::vector<bool> dilated(std::vector<bool> marked, int steps) {
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y * kWidth + x); };
  for (int s = 0; s < steps; ++s) {
    std::vector<bool> out = marked;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (marked[at(x, y)])
          for (int j = std::max(0, y - 1); j <= std::min(kHeight - 1, y + 1); ++j)
            for (int i = std::max(0, x - 1); i <= std::min(kWidth - 1, x + 1); ++i) out[at(i, j)] = true;
    marked = std::move(out);
  }
  return marked;
}

Tally judge(const Values& v, const Values& reference) {
  Tally t;
  std::vector<bool> penumbra(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) penumbra[i] = reference[i] > 0.0f && reference[i] < 1.0f;
  const std::vector<bool> near = dilated(penumbra, 2);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const bool off = std::abs(v[i] - reference[i]) > 0.5f;
    t.penumbra += penumbra[i];
    t.far_off += off && penumbra[i];
    t.outside += off && !near[i];
  }
  return t;
}

TEST(DBufferPoses, NoLeaksSpecksSeamsOrAcne) {
  const std::unique_ptr<gl::Context> context = gl::make_context(gl::Backend::kOsMesa);
  const int poses = std::getenv("PENUMBRA_LONG") ? 100 : 10;
  Tally all;
  for (int k = 0; k < poses; ++k) {
    const testing::Pose pose = testing::random_pose(kMeshes[static_cast<std::size_t>(k) % kMeshes.size()], 1000 + k);
    const Scene scene = testing::load_pose(pose);
    const View view(scene, kWidth, kHeight);
    DBuffer buffer(*context, scene, view.rays);
    buffer.set_surface(view.surface);
    const Values v = buffer.render(scene.light, {}).visibility;
    const Tally t = judge(v, view.trace(testing::every_pixel(view.surface), 256, 5));
    {
      const Values ref = view.trace(testing::every_pixel(view.surface), 256, 5);
      const Values hard = trace_hard(scene, view.rays, view.surface, testing::every_pixel(view.surface)).visibility;
      std::vector<bool> pen(v.size());
      for (std::size_t i = 0; i < v.size(); ++i) pen[i] = ref[i] > 0.0f && ref[i] < 1.0f;
      const std::vector<bool> near = dilated(pen, 2);
      for (std::size_t i = 0; i < v.size(); ++i)
        if (std::abs(v[i] - ref[i]) > 0.5f) {
          const Vec3 d = scene.light.center - view.surface.position[i];
          std::printf("  %s %s r %.3f (%3d,%3d) v %.3f ref %.3f hard %.0f object %d cos %.3f horizon %.3f\n", pose.name.c_str(), near[i] ? "in" : "OUT", scene.light.radius,
                      int(i) % kWidth, int(i) / kWidth, v[i], ref[i], hard[i], view.surface.object[i],
                      glm::dot(view.surface.normal[i], glm::normalize(d)), fraction_above_horizon(scene.light, view.surface.position[i], view.surface.normal[i]));
        }
    }
    std::printf("%-20s penumbra %5zu, off by .5: %4zu, outside: %4zu\n", pose.name.c_str(), t.penumbra, t.far_off,
                t.outside);
    all.penumbra += t.penumbra, all.far_off += t.far_off, all.outside += t.outside;
  }
  std::printf("%zu pixels of penumbra, %zu off by more than .5, %zu outside of it\n", all.penumbra, all.far_off,
              all.outside);
  EXPECT_GT(all.penumbra, 1'000u * static_cast<unsigned>(poses) / 10u);
  EXPECT_LE(static_cast<double>(all.far_off), 0.01 * static_cast<double>(all.penumbra));
  EXPECT_EQ(all.outside, 0u);
}

}  // namespace
}  // namespace penumbra
