#include "penumbra/volumes/volumes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "tests/volumes/volume_support.h"

namespace penumbra {
namespace {

using testing::kLight;

TEST(BuildShadowVolumes, RefusesWhatItCannotUse) {
  const TriangleMesh cube = make_box(Vec3(0.0), Vec3(1.0));
  EXPECT_THROW(build_shadow_volumes(TriangleMesh(), kLight), MeshError);
  VolumeOptions options;
  options.extrude.cone_segments = 2;
  EXPECT_THROW(build_shadow_volumes(cube, kLight, options), UsageError);
  options.extrude.cone_segments = 3;
  EXPECT_NO_THROW(build_shadow_volumes(cube, kLight, options));
  options.extrude.bound_radius = -1.0;
  EXPECT_THROW(build_shadow_volumes(cube, kLight, options), UsageError);
}

TEST(BuildShadowVolumes, RefusesOptionsEvenWhereNothingIsExtruded) {
  VolumeOptions options{.penumbra = false, .umbra = false};
  options.extrude.cone_segments = 2;
  EXPECT_THROW(build_shadow_volumes(make_box(Vec3(0.0), Vec3(1.0)), kLight, options), UsageError);
}

TEST(BuildShadowVolumes, MakesThePenumbraAndTheExactUmbraUnlessToldOtherwise) {
  const TriangleMesh box = make_box({0, 5, 0}, Vec3(1.0));
  const ShadowVolumes v = build_shadow_volumes(box, kLight);
  EXPECT_TRUE(v.sheets.triangles.empty());
  EXPECT_FALSE(v.penumbra.triangles.empty());
  EXPECT_EQ(v.penumbra.guarantee, Guarantee::kContains);
  EXPECT_EQ(v.umbra.guarantee, Guarantee::kExact);
  const ShadowMesh umbra = convex_umbra(box, kLight, v.classes);
  EXPECT_FALSE(umbra.triangles.empty());
  EXPECT_EQ(v.umbra.positions, umbra.positions);
  EXPECT_EQ(v.umbra.triangles, umbra.triangles);
}

std::vector<std::string> stage_names(const VolumeOptions& options) {
  std::vector<std::string> names;
  for (const StageTime& stage :
       build_shadow_volumes(make_box({0, 5, 0}, Vec3(1.0)), kLight, options).stages) {
    EXPECT_GE(stage.milliseconds, 0.0);
    names.push_back(stage.name);
  }
  return names;
}

TEST(BuildShadowVolumes, TimesTheStagesThatItRuns) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(stage_names({.penumbra = false, .umbra = false}), (Names{"classify", "silhouettes"}));
  EXPECT_EQ(stage_names({.sheets = true}), (Names{"classify", "silhouettes", "sheets", "penumbra", "umbra"}));
}

TEST(BuildShadowVolumes, WithoutProductsStillClassifiesAndFindsSilhouettes) {
  const TriangleMesh box = make_box({0, 5, 0}, Vec3(1.0));
  const ShadowVolumes v = build_shadow_volumes(box, kLight, {.penumbra = false, .umbra = false});
  EXPECT_EQ(v.classes.faces, classify_faces(box, kLight).faces);
  EXPECT_EQ(v.silhouettes.band, find_silhouettes(box, v.classes).band);
  for (const ShadowMesh* mesh : {&v.sheets, &v.penumbra, &v.umbra}) {
    EXPECT_TRUE(mesh->positions.empty());
    EXPECT_EQ(mesh->guarantee, Guarantee::kNone);
  }
}

TEST(BuildShadowVolumes, ProgressRunsOnceFromNothingToAll) {
  std::vector<double> fractions;
  VolumeOptions options{.sheets = true};
  options.extrude.progress = [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  build_shadow_volumes(make_box({0, 5, 0}, Vec3(1.0)), kLight, options);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
}

}  // namespace
}  // namespace penumbra
