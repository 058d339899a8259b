// What is meant by an object's name.
#include "apps/cli/sun/surface.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

Scene scene_of(const std::vector<std::string>& names) {
  Scene scene;
  for (const std::string& name : names) scene.objects.push_back({.name = name, .mesh = {}});
  return scene;
}

using Numbers = std::vector<std::size_t>;

TEST(ObjectsNamed, TilesAreMeantByTheNameOfAll) {
  const Scene scene = scene_of({"floor", "hill[0,0]", "hill[0,12]", "box[1]", "[1,2]", "box[1,a]", "box[,]"});
  EXPECT_EQ(objects_named(scene, "hill"), (Numbers{1, 2}));
  EXPECT_EQ(objects_named(scene, "hill[0,12]"), Numbers{2});
  EXPECT_EQ(objects_named(scene, "2"), Numbers{2});
  EXPECT_EQ(objects_named(scene, "[1,2]"), Numbers{4});
  EXPECT_THROW(objects_named(scene, "box"), UsageError) << "none of these is a tile";
}

TEST(ObjectsNamed, NamesMayBeLong) {
  const std::string name(1'000'000, 'a');
  const Scene scene = scene_of({name, name + "b[0,0]"});
  EXPECT_EQ(objects_named(scene, name + "b"), Numbers{1});
}

}  // namespace
}  // namespace penumbra::apps
