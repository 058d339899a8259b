#include "render/support/nearest_word.h"

#include <gtest/gtest.h>

#include <vector>

namespace penumbra {
namespace {

const std::vector<std::string> kMethods = {"silhouette", "reference",         "rays", "hard", "none",
                                           "dbuffer",    "occlusion-textures"};

TEST(NearestWord, TakesFewLetters) {
  EXPECT_EQ(nearest_word("silhouete", kMethods), "silhouette");
  EXPECT_EQ(nearest_word("sillhouettes", kMethods), "silhouette");
  EXPECT_EQ(nearest_word("refernece", kMethods), "reference");
  EXPECT_EQ(nearest_word("d-buffer", kMethods), "dbuffer");
  EXPECT_EQ(nearest_word("arys", kMethods), "rays") << "swapped letters are one step";
}

TEST(NearestWord, TakesBeginningsAndAnyCase) {
  EXPECT_EQ(nearest_word("occ", kMethods), "occlusion-textures");
  EXPECT_EQ(nearest_word("DBUFFER", kMethods), "dbuffer");
  EXPECT_EQ(nearest_word("r", kMethods), "reference") << "the first of several";
}

TEST(NearestWord, IsNoneWhereAllAreFar) {
  EXPECT_EQ(nearest_word("magic", kMethods), "");
  EXPECT_EQ(nearest_word("", kMethods), "");
  EXPECT_EQ(nearest_word("photon", {}), "");
  EXPECT_EQ(nearest_word(std::string(100'000, 'x'), kMethods), "");
  EXPECT_EQ(did_you_mean("magic", kMethods), "");
  EXPECT_EQ(did_you_mean("nine", kMethods), " (did you mean none?)");
}

}  // namespace
}  // namespace penumbra
