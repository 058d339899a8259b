// Settings that a study leaves out, since a cheaper one took too long.
#include "apps/cli/study/measure/too_long.h"

#include <gtest/gtest.h>

namespace penumbra::apps {
namespace {

Setting reference(std::uint64_t samples, const char* word = "none") {
  return {.method = "reference", .options = {{"samples", samples}, {"denoise", word}}, .varied = "samples"};
}

TEST(TooLong, LeavesOutWhatIsDearer) {
  TooLong too_long(20'000.0);
  too_long.saw(reference(64), 19'000.0);
  EXPECT_FALSE(too_long.why_not(reference(256)));
  too_long.saw(reference(256), 21'000.0);
  EXPECT_FALSE(too_long.why_not(reference(64)));
  EXPECT_EQ(too_long.why_not(reference(1024)), "left out: a frame by reference took 21 s");
  EXPECT_FALSE(too_long.why_not(reference(1024, "a-trous"))) << "another option differs";
  Setting other = reference(1024);
  other.method = "rays";
  EXPECT_FALSE(too_long.why_not(other));
}

TEST(TooLong, WithoutALimitNothingIs) {
  TooLong too_long(0.0);
  too_long.saw(reference(64), 1e9);
  EXPECT_FALSE(too_long.why_not(reference(256)));
}

}  // namespace
}  // namespace penumbra::apps
