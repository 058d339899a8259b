#include "render/rays/ray_packets.h"

#include <gtest/gtest.h>

#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using detail::Coherence;
using detail::RayPacket;

/// Two casters over a floor that casts nothing. The light's center is the origin of the frame of the rays.
struct Plates {
  Scene scene = testing::scene_in_light_frame(
      0.1, {testing::rectangle(-1, 1, -1, 1, 2), testing::rectangle(0, 2, -1, 1, 3)});
  Plates() { scene.objects.push_back({"floor", testing::rectangle(-9, 9, -9, 9, 8), Vec3(0.8), false}); }
};

/// Ray k from (k/4 - 2.05, 0, 4) along -z as far as `to`.
void aim(double to, RayPacket& packet) {
  for (std::size_t k = 0; k < RayPacket::kRays; ++k) {
    packet.set(k, {{.point = {0.25 * static_cast<double>(k) - 2.05, 0, 4}}, {0, 0, to - 4.0}});
    packet.wanted[k] = k % 5 == 0 ? 0 : -1;
  }
}

TEST(RayPackets, TellWhichWantedRaysAreOccluded) {
  const Plates plates;
  const RayScene rays(plates.scene, 1);
  RayPacket packet;
  int occluded = 0;
  for (const Coherence coherence : {Coherence::kCoherent, Coherence::kIncoherent, Coherence::kSingly})
    for (const double to : {0.5, 2.5, 3.5}) {  // beyond both plates, one, none
      aim(to, packet);
      detail::find_occluded(rays, packet, coherence);
      for (std::size_t k = 0; k < RayPacket::kRays; ++k) {
        const double x = 0.25 * static_cast<double>(k) - 2.05;
        const bool hidden = (to < 2.0 && std::abs(x) < 1.0) || (to < 3.0 && x > 0.0);
        EXPECT_EQ(packet.is_occluded(k), hidden && k % 5 != 0) << "ray " << k << " to " << to;
        occluded += packet.is_occluded(k);
      }
    }
  EXPECT_GT(occluded, 20);
}

TEST(RayPackets, FirstHitIsTheNearestFaceOfACaster) {
  const Plates plates;
  const RayScene rays(plates.scene, 1);
  const auto hit = [&](double x, double y, double way, bool endless = true) {
    return detail::first_hit(rays, {{.point = {x, y, 9}}, {0, 0, -way}, endless});
  };
  const auto near = hit(0.5, 0.2, 1), far = hit(-0.5, 0.2, 2), other = hit(-0.5, -0.8, 1);
  ASSERT_TRUE(near && far && other);
  EXPECT_EQ(near->object, 1u);
  EXPECT_NEAR(near->distance, 6.0, 1e-12);
  EXPECT_EQ(far->object, 0u);
  EXPECT_NEAR(far->distance, 3.5, 1e-12);
  EXPECT_EQ(far->face, 1u);
  EXPECT_EQ(other->face, 0u) << "on the other side of the diagonal";
  EXPECT_FALSE(hit(-0.5, 0.2, 6.5, false)) << "it ends before the plate";
  EXPECT_FALSE(hit(-3.0, 0.2, 1)) << "the floor does not cast";
}

}  // namespace
}  // namespace penumbra
