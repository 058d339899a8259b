// The D-buffer over scenes by chance: no leak, speck, seam or acne. Ten scenes; a hundred with PENUMBRA_LONG
// set.
#include <gtest/gtest.h>

#include <cstdlib>

#include "render/d_buffer/d_buffer.h"
#include "tests/render/random_poses.h"

namespace penumbra {
namespace {

using testing::Pixels;
using testing::Values;
using testing::View;

constexpr int kWidth = 160, kHeight = 120;
constexpr std::array kMeshes{"scenes/cube.off", "meshes/bunny.ply", "meshes/knot1.ply",
                             "meshes/armadillo.ply", "meshes/fandisk.ply"};

struct Tally {
  std::size_t penumbra = 0;  ///< pixels in true penumbra
  std::size_t far_off = 0;   ///< of these, more than .5 from the reference
  std::size_t outside = 0;   ///< more than .5 off and not within two pixels of the penumbra
};

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * kWidth + x);
}

/// Pixels within `steps` of a marked one.
std::vector<bool> dilated(std::vector<bool> marked, int steps) {
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

/// Pixels that are partly lit, or lit beside a dark one of the same object: the penumbra passes between them.
std::vector<bool> penumbra_pixels(const Values& reference, const SurfaceBuffer& surface) {
  std::vector<bool> out(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) out[i] = reference[i] > 0.0f && reference[i] < 1.0f;
  const auto mark = [&](std::size_t i, std::size_t j) {
    if (surface.object[i] == surface.object[j] && std::abs(reference[i] - reference[j]) == 1.0f)
      out[i] = true;
  };
  for (int y = 0; y + 1 < kHeight; ++y)
    for (int x = 0; x + 1 < kWidth; ++x) {
      mark(at(x, y), at(x + 1, y));
      mark(at(x, y), at(x, y + 1));
    }
  return out;
}

Tally judge(const Values& v, const Values& reference, const SurfaceBuffer& surface) {
  Tally t;
  const std::vector<bool> near = dilated(penumbra_pixels(reference, surface), 2);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const bool off = std::abs(v[i] - reference[i]) > 0.5f;
    const bool partial = reference[i] > 0.0f && reference[i] < 1.0f;
    t.penumbra += partial;
    t.far_off += off && partial;
    t.outside += off && !near[i];
  }
  return t;
}

TEST(DBufferPoses, NoLeaksSpecksSeamsOrAcne) {
  const std::unique_ptr<gl::Context> context = gl::make_context(gl::Backend::kOsMesa);
  const int poses = std::getenv("PENUMBRA_LONG") ? 100 : 10;
  Tally all;
  for (int k = 0; k < poses; ++k) {
    const testing::Pose pose = testing::random_pose(kMeshes[static_cast<std::size_t>(k) % kMeshes.size()],
                                                    1000 + static_cast<std::uint64_t>(k));
    const Scene scene = testing::load_pose(pose);
    const View view(scene, kWidth, kHeight);
    DBuffer buffer(*context, scene, view.rays);
    buffer.set_surface(view.surface.receivers());
    const Values v = buffer.render(testing::light_of(scene), {}).visibility;
    const Tally t = judge(v, view.trace(testing::every_pixel(view.surface), 256, 5), view.surface);
    std::printf("%-20s penumbra %5zu, off by .5: %4zu, outside: %4zu\n", pose.name.c_str(), t.penumbra,
                t.far_off, t.outside);
    all.penumbra += t.penumbra, all.far_off += t.far_off, all.outside += t.outside;
  }
  std::printf("%zu pixels of penumbra, %zu off by more than .5, %zu outside of it\n", all.penumbra,
              all.far_off, all.outside);
  EXPECT_GT(all.penumbra, 1'000u * static_cast<unsigned>(poses) / 10u);
  EXPECT_LE(static_cast<double>(all.far_off), 0.01 * static_cast<double>(all.penumbra));
  EXPECT_EQ(all.outside, 0u);
}

// Entries of one texel are not all there are: a caster that is added can hide an entry that darkened more.
TEST(DBufferPoses, VisibilityMayRiseWhereACasterIsAddedButSeldom) {
  const std::unique_ptr<gl::Context> context = gl::make_context(gl::Backend::kOsMesa);
  std::size_t rises = 0, pixels = 0;
  for (int k = 0; k < 5; ++k) {
    Scene scene = testing::load_pose(
        testing::random_pose(kMeshes[static_cast<std::size_t>(k)], 2000 + static_cast<std::uint64_t>(k)));
    const View view(scene, kWidth, kHeight);
    const auto render = [&] {
      const RayScene rays(scene, 0);
      DBuffer buffer(*context, scene, rays);
      buffer.set_surface(view.surface.receivers());
      return buffer.render(testing::light_of(scene), {}).visibility;
    };
    const Values before = render();
    const Vec3 between = 0.4 * testing::light_of(scene).center + 0.6 * scene.bounds().center();
    scene.objects.push_back({"added", make_box(between, {0.2, 0.1, 0.3}), Vec3(0.8), true});
    const Values after = render();
    for (std::size_t i = 0; i < after.size(); ++i) rises += after[i] > before[i] + 0.01f;
    pixels += after.size();
  }
  std::printf("a caster added: visibility rises by more than .01 at %zu of %zu pixels\n", rises, pixels);
  EXPECT_LE(static_cast<double>(rises), 0.03 * static_cast<double>(pixels));
}

}  // namespace
}  // namespace penumbra
