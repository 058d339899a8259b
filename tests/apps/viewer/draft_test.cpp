// Drafts are as fine as the time allows, and do not change back and forth.
#include "apps/viewer/work/draft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace penumbra::viewer {
namespace {

/// Drafts of a picture that takes `full` milliseconds at full size, of which `fixed` do not depend on its
/// size; returns the reductions that were drawn.
std::vector<int> draw(DraftPolicy& policy, double full, double fixed, int count) {
  std::vector<int> reductions;
  for (int i = 0; i < count; ++i) {
    const int r = policy.reduction();
    reductions.push_back(r);
    policy.took(fixed + (full - fixed) / (r * r), false);
  }
  return reductions;
}

int changes(const std::vector<int>& reductions) {
  int count = 0;
  for (std::size_t i = 1; i < reductions.size(); ++i) count += reductions[i] != reductions[i - 1];
  return count;
}

std::ptrdiff_t drawn_at(const std::vector<int>& reductions, int reduction) {
  return std::ranges::count(reductions, reduction);
}

TEST(DraftPolicy, DrawsInFullWhatIsFastEnough) {
  for (const double full : {1.0, 20.0, 34.0, 36.0}) {
    DraftPolicy policy;
    EXPECT_EQ(draw(policy, full, 0.0, 50), std::vector<int>(50, 1)) << full;
  }
}

TEST(DraftPolicy, StartsCoarserWhereThePictureBeforeWasSlow) {
  DraftPolicy policy;
  policy.took_in_full(4000.0, false, true);
  EXPECT_EQ(policy.reduction(), 6);
}

TEST(DraftPolicy, IsNotHeldUpByAFirstPicture) {
  DraftPolicy policy;
  policy.start(140.0);
  EXPECT_EQ(draw(policy, 30.0, 3.0, 4), (std::vector<int>{2, 1, 1, 1}));
  policy.start(4000.0);
  EXPECT_EQ(policy.reduction(), 6);
}

// One slow draft, then as fine as the budget allows: 200 ms are 50 at half size and 22 at a third.
TEST(DraftPolicy, DrawsCoarserWhatIsSlow) {
  DraftPolicy policy;
  const std::vector<int> reductions = draw(policy, 200.0, 0.0, 200);
  EXPECT_EQ(reductions[0], 1);
  EXPECT_GT(drawn_at(reductions, 3), 180);
  for (std::size_t i = 1; i < 8; ++i) EXPECT_GE(reductions[i], 2) << i;
  EXPECT_EQ(draw(policy, 2000.0, 0.0, 20).back(), 6) << "no coarser than that";
}

TEST(DraftPolicy, ComesBackWhenTheSceneIsFastAgain) {
  DraftPolicy policy;
  draw(policy, 200.0, 0.0, 200);
  EXPECT_EQ(draw(policy, 30.0, 0.0, 80).back(), 1) << "at the latest when full size is tried again";
}

// Something else on the machine holds up one draft.
TEST(DraftPolicy, OneSlowDraftChangesNothing) {
  DraftPolicy policy;
  draw(policy, 30.0, 0.0, 10);
  policy.took(50.0, false);
  EXPECT_EQ(policy.reduction(), 1);
  policy.took(50.0, false);
  EXPECT_GT(policy.reduction(), 1) << "two of them do";
}

// 15 ms at half size are 47 in full, by the pixels; 33 where 9 are fixed.
TEST(DraftPolicy, StartsInFullWhereThePictureBeforeWasFastEnough) {
  DraftPolicy policy;
  policy.took(60.0, false);
  ASSERT_EQ(policy.reduction(), 2);
  policy.took(15.0, false);
  ASSERT_EQ(policy.reduction(), 2);
  policy.took_in_full(33.0, true, false);
  EXPECT_EQ(policy.reduction(), 1);
}

// A reference of 256 rays tells nothing of drafts of 16; a picture of the same options tells what they take.
TEST(DraftPolicy, ASlowPictureCountsOnlyWhereADraftIsTheSame) {
  for (const bool as_cheap : {false, true}) {
    DraftPolicy policy;
    policy.took(100.0, false);
    ASSERT_EQ(policy.reduction(), 2);
    policy.took_in_full(100.0, true, as_cheap);
    policy.took(10.0, true);  // some 31 in full, by the pixels
    EXPECT_EQ(policy.reduction(), as_cheap ? 2 : 1);
  }
}

// As on a busy machine: 23 ms at half size, 34 in full.
TEST(DraftPolicy, TriesFullSizeAgainWhereMuchOfTheTimeIsFixed) {
  DraftPolicy policy;
  policy.took(60.0, false);
  ASSERT_EQ(policy.reduction(), 2);
  EXPECT_EQ(draw(policy, 34.0, 19.33, 30).back(), 1);
}

TEST(DraftPolicy, DoesNotChangeBackAndForth) {
  for (const double full : {35.0, 37.0, 40.0, 42.0, 50.0, 80.0, 140.0, 150.0})
    for (const double fixed : {0.0, 3.0, 15.0}) {
      DraftPolicy policy;
      draw(policy, full, fixed, 100);
      // 300 drafts are some ten seconds; a finer one is tried once in 64.
      EXPECT_LE(changes(draw(policy, full, fixed, 300)), 10) << full << " of which fixed " << fixed;
    }
}

TEST(DraftPolicy, WhatACameraTakesIsForgottenWithIt) {
  DraftPolicy policy;
  for (int i = 0; i < 10; ++i) policy.took(policy.reduction() == 1 ? 80.0 : 25.0, true);
  ASSERT_EQ(policy.reduction(), 2);
  policy.took(10.0, false);  // a light's draft; some 31 in full, by the pixels
  EXPECT_EQ(policy.reduction(), 1) << "80 were the camera's";
}

TEST(DraftPolicy, ChangesOptionsOfDraftsAlone) {
  DraftPolicy policy;
  const RenderOptions options{.method = "reference", .width = 641, .height = 480};
  EXPECT_EQ(policy.draft_of(options).width, 641);
  EXPECT_EQ(policy.draft_of(options).options.at("samples"), OptionValue(std::uint64_t{16}));
  while (policy.reduction() < 2) policy.took(60.0, false);
  EXPECT_EQ(policy.draft_of(options).width, 321);
  EXPECT_EQ(policy.draft_of(options).height, 240);
}

TEST(DraftPolicy, KnowsWhichOptionsADraftLeavesAsTheyAre) {
  RenderOptions options{.method = "reference"};
  EXPECT_FALSE(DraftPolicy::is_as_cheap(options));
  options.options["samples"] = std::uint64_t{8};
  EXPECT_TRUE(DraftPolicy::is_as_cheap(options));
  EXPECT_TRUE(DraftPolicy::is_as_cheap({.method = "silhouette"}));
}

}  // namespace
}  // namespace penumbra::viewer
