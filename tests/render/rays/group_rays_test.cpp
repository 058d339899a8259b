// Rays in a group's frame: what is not traced must not disturb what is.
#include "render/rays/group_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace penumbra::detail {
namespace {

// On processors without 512-bit registers Embree checks all sixteen rays, valid or not.
TEST(GroupRays, ThatAreNotValidEndBeforeTheyBegin) {
  RayPacket packet;
  for (std::size_t k = 0; k < RayPacket::kRays; ++k) packet.set(k, {.from = {{0, 0, 0}}, .way = {0, 0, 1}});
  packet.set(3, {.from = {{0, 0, std::numeric_limits<double>::quiet_NaN()}}, .way = Vec3(1e300)});
  packet.set(4, {.from = {{1e300, 0, 0}}, .way = {0, 0, 1}});  // misses the box
  for (std::size_t k = 0; k < RayPacket::kRays; ++k) packet.wanted[k] = k == 3 ? 0 : -1;
  GroupRays rays;
  ASSERT_TRUE(rays.set(packet, packet.wanted, {}));
  for (std::size_t k = 0; k < RayPacket::kRays; ++k) {
    EXPECT_EQ(rays.valid[k] != 0, k != 3 && k != 4) << k;
    EXPECT_EQ(rays.ray.tfar[k] > rays.ray.tnear[k], rays.valid[k] != 0) << k;
    for (const float x : {rays.ray.org_x[k], rays.ray.org_y[k], rays.ray.org_z[k], rays.ray.dir_x[k],
                          rays.ray.dir_y[k], rays.ray.dir_z[k]})
      EXPECT_LT(std::abs(x), 2.0f) << k;
  }
}

}  // namespace
}  // namespace penumbra::detail
