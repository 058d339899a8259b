#include "render/image/srgb.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

// Where one byte ends and the next begins, number by number, and everywhere else at random.
TEST(SrgbTable, IsTheCurve) {
  const SrgbTable table;
  int bytes = 0;
  unsigned char before = 0;
  for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(1.001f); bits += 1009) {
    const float x = std::bit_cast<float>(bits);
    const unsigned char byte = to_srgb_by_curve(x);
    ASSERT_EQ(table(x), byte) << x;
    if (byte == before) continue;
    ++bytes;
    before = byte;
    for (std::uint32_t near = bits - 1009; near <= bits; ++near) {
      const float y = std::bit_cast<float>(near);
      ASSERT_EQ(table(y), to_srgb_by_curve(y)) << y;
    }
  }
  EXPECT_EQ(bytes, 255);
}

TEST(SrgbTable, TakesAnyNumber) {
  const SrgbTable table;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float x : {0.0f, -0.0f, -1.0f, 1e-40f, 1.0f, 7.0f, kInfinity, -kInfinity, std::nanf("")})
    EXPECT_EQ(table(x), to_srgb_by_curve(x)) << x;
}

}  // namespace
}  // namespace penumbra::detail
