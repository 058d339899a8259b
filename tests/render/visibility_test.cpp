// The one call for visibility: receivers in any order, with and without normals, and what is refused.
#include "penumbra/render/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <thread>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/renderer.h"
#include "render/silhouette/light_rays.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Values;

/// Receivers that a test owns.
struct Points {
  std::vector<Vec3> points, normals;
  std::vector<std::int32_t> objects;
  std::vector<std::uint32_t> faces;

  Receivers receivers() const {
    return {.points = points, .normals = normals, .objects = objects, .faces = faces};
  }
  Points in_order(const std::vector<std::uint32_t>& order) const {
    Points out;
    for (const std::uint32_t i : order) out.add(points[i], normals[i], objects[i], faces[i]);
    return out;
  }
  void add(const Vec3& point, const Vec3& normal, std::int32_t object, std::uint32_t face) {
    points.push_back(point);
    normals.push_back(normal);
    objects.push_back(object);
    faces.push_back(face);
  }
};

/// What the pixels listed see.
Points points_of(const SurfaceBuffer& surface, const testing::Pixels& pixels) {
  Points out;
  for (const std::uint32_t i : pixels)
    out.add(surface.position[i], surface.normal[i], surface.object[i], surface.face[i]);
  return out;
}

VisibilityOptions by(const std::string& method) {
  VisibilityOptions options;
  options.method = method;
  options.options = {{"samples", std::uint64_t{64}}};
  return options;
}

struct Timed {
  MethodResult result;
  double ms = 0.0;
};
Timed timed(const Casters& casters, const LightShape& light, const Points& points,
            const VisibilityOptions& options) {
  StageClock clock;
  Timed out{visibility(casters, light, points.receivers(), options)};
  clock.finish("visibility");
  out.ms = clock.stages().front().milliseconds;
  return out;
}

class InAnyOrder : public ::testing::TestWithParam<const char*> {};

TEST_P(InAnyOrder, ReceiversSeeTheSameToTheBit) {
  const std::string method = GetParam();
  for (const char* name : {"bunny-medium", "knot1-medium"}) {
    const Scene scene = testing::data_scene(name);
    RenderOptions picture;
    picture.method = method;
    picture.options = by(method).options;
    picture.width = 480, picture.height = 360;
    const RenderResult drawn = render(scene, picture);
    testing::Pixels pixels;
    for (std::uint32_t i = 0; i < drawn.surface.size(); ++i)
      if (drawn.surface.hit(i)) pixels.push_back(i);
    ASSERT_GE(pixels.size(), 100'000u) << name;
    pixels.resize(100'000);
    const Points points = points_of(drawn.surface, pixels);

    testing::Pixels order = testing::first_pixels(points.points.size());
    std::shuffle(order.begin(), order.end(), std::mt19937_64(17));
    const Casters casters(scene.objects);
    const LightShape& light = scene.lights.front().shape;
    visibility(casters, light, points.receivers(), by(method));  // one-time set-up
    const Timed straight = timed(casters, light, points, by(method)),
                mixed = timed(casters, light, points.in_order(order), by(method));
    std::size_t differ = 0, regions_differ = 0, from_pixels = 0;
    float most = 0.0f;
    const MethodResult &a = straight.result, &b = mixed.result;
    ASSERT_EQ(a.visibility.size(), order.size());
    ASSERT_EQ(b.region.size(), a.region.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      differ += a.visibility[order[i]] != b.visibility[i];
      if (!a.region.empty()) regions_differ += a.region[order[i]] != b.region[i];
      const float off = std::abs(a.visibility[i] - drawn.lights[0].visibility[pixels[i]]);
      from_pixels += off != 0.0f;
      most = std::max(most, off);
    }
    std::printf(
        "%s, %s: in picture order %.1f ms, in random order %.1f ms; %zu receivers differ from the same "
        "as pixels, by at most %.2g\n",
        name, method.c_str(), straight.ms, mixed.ms, from_pixels, double{most});
    EXPECT_EQ(differ, 0u) << name;
    EXPECT_EQ(regions_differ, 0u) << name;
    // The reference has other samples for pixels: two estimates from 64 rays. The others only group receivers
    // otherwise.
    EXPECT_LE(most, method == "reference" ? 0.25f : 1e-5f) << name;
    EXPECT_EQ(a.region.empty(), !method_named(method).certifies);
  }
}

INSTANTIATE_TEST_SUITE_P(Visibility, InAnyOrder, ::testing::Values("silhouette", "reference", "hard"),
                         [](const auto& method) { return std::string(method.param); });

/// Points in the air between a torus and its floor, turned at random.
Points points_in_the_air(const Scene& scene, std::size_t count) {
  testing::Random random(23);
  const Bounds box = scene.caster_bounds();
  Points out;
  while (out.points.size() < count) {
    const Vec3 p = box.center() + 1.5 * box.radius() * random.point() - Vec3(0, 0.7 * box.radius(), 0);
    if (p.y > 0.05 && !is_behind(testing::light_of(scene), p)) out.add(p, random.direction(), 0, 1u << 20);
  }
  return out;
}

/// How many receivers see more or less without their normals than O says with them.
std::size_t differing_without_normals(const std::string& method, double most) {
  const Scene scene = testing::data_scene("torus-medium");
  const Casters casters(scene.objects);
  const LightShape& light = scene.lights.front().shape;
  const Points points = points_in_the_air(scene, 20'000);
  VisibilityOptions options = by(method);
  options.with_unoccluded = true;
  const MethodResult with = visibility(casters, light, points.receivers(), options);
  const MethodResult without = visibility(casters, light, {.points = points.points}, options);
  EXPECT_EQ(without.unoccluded, without.visibility) << method;
  EXPECT_EQ(with.unoccluded.size(), points.points.size()) << method;
  std::size_t partly = 0, cut = 0, differ = 0;
  for (std::size_t i = 0; i < with.unoccluded.size(); ++i) {
    partly += with.unoccluded[i] > 0.0f && with.unoccluded[i] < 1.0f;
    cut += with.visibility[i] < with.unoccluded[i];
    EXPECT_LE(with.visibility[i], with.unoccluded[i] + 1e-5f) << method << ", " << i;
    differ += std::abs(with.unoccluded[i] - without.visibility[i]) > most;
  }
  EXPECT_GT(partly, 1'000u) << method << ": a test of penumbra";
  EXPECT_GT(cut, 5'000u) << method << ": a test of horizons";
  return differ;
}

TEST(Visibility, WithoutNormalsIsWithoutAHorizon) {
  EXPECT_EQ(differing_without_normals("silhouette", 1e-5), 0u);
  // Of 64 × 20,000 rays one in 25,000 passes an edge on the other side.
  EXPECT_LE(differing_without_normals("reference", 1e-3), 50u);
}

TEST(Visibility, OfNoReceiversIsNone) {
  const Scene scene = testing::data_scene("cube-medium");
  const Casters casters(scene.objects);
  for (const char* method : {"silhouette", "reference", "rays", "hard", "none"}) {
    VisibilityOptions options = by(method);
    options.with_unoccluded = true;
    const MethodResult r = visibility(casters, scene.lights.front().shape, {}, options);
    EXPECT_TRUE(r.visibility.empty() && r.region.empty() && r.unoccluded.empty()) << method;
  }
}

TEST(Visibility, IsOneWhereThereIsNoReceiverOrNoCaster) {
  const std::vector<Vec3> points{{0, 1, 0}, {0.1, 1, 0}, {0.2, 1, 0}};
  const std::vector<std::int32_t> objects{-1, 0, -1};
  const DiskLight light{{0, 4, 0}, {0, -1, 0}, 0.5};
  const Casters roof(std::vector<TriangleMesh>{make_box({0, 2, 0}, {3, 0.1, 3})});
  const Casters none(std::vector<TriangleMesh>{});
  for (const char* method : {"silhouette", "reference", "rays", "hard"}) {
    const Receivers receivers{.points = points, .objects = objects};
    EXPECT_EQ(visibility(roof, light, receivers, by(method)).visibility, (Values{1, 0, 1})) << method;
    EXPECT_EQ(visibility(none, light, receivers, by(method)).visibility, (Values{1, 1, 1})) << method;
  }
}

TEST(Visibility, CallsOfSeveralThreadsWaitForEachOther) {
  const Scene scene = testing::data_scene("torus-medium");
  const Casters casters(scene.objects);
  const Points points = points_in_the_air(scene, 2'000);
  LightShape far = scene.lights.front().shape;
  std::get<DiskLight>(far).center.y += 1.0;
  const std::vector<LightShape> lights{scene.lights.front().shape, far};
  std::vector<Values> alone;
  for (const LightShape& light : lights)
    alone.push_back(visibility(casters, light, points.receivers()).visibility);
  ASSERT_NE(alone[0], alone[1]);
  std::vector<std::vector<Values>> seen(lights.size());
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < lights.size(); ++k)
    threads.emplace_back([&, k] {
      for (int i = 0; i < 10; ++i)
        seen[k].push_back(visibility(casters, lights[k], points.receivers()).visibility);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < lights.size(); ++k)
    for (const Values& values : seen[k]) EXPECT_EQ(values, alone[k]) << k;
}

class Refused : public ::testing::Test {
 protected:
  std::string message(const Receivers& receivers, const VisibilityOptions& options = {},
                      const LightShape& light = DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}) const {
    try {
      visibility(casters_, light, receivers, options);
    } catch (const UsageError& e) {
      return e.what();
    }
    return "not refused";
  }
  Casters casters_{std::vector<TriangleMesh>{make_box({0, 2, 0}, {1, 1, 1})}};
  std::vector<Vec3> points_{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  Receivers good_{.points = points_};
};

TEST_F(Refused, ArraysOfOtherLengths) {
  const std::vector<Vec3> normals(3, Vec3(0, 1, 0));
  const std::vector<std::int32_t> objects(5, 0);
  const std::vector<std::uint32_t> faces(1, 0);
  EXPECT_EQ(message(good_), "not refused");
  EXPECT_NE(message({.points = points_, .normals = normals}).find("3 normals"), std::string::npos);
  EXPECT_NE(message({.points = points_, .objects = objects}).find("5 objects"), std::string::npos);
  EXPECT_NE(message({.points = points_, .faces = faces}).find("1 faces"), std::string::npos);
  EXPECT_NE(message({.points = points_, .width = 3, .height = 2}).find("3x2"), std::string::npos);
}

TEST_F(Refused, NumbersThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<Vec3> points = points_, normals(4, Vec3(0, 1, 0));
    points[2].y = bad;
    EXPECT_EQ(message({.points = points}), "the point of receiver 2 is not finite");
    normals[3].z = bad;
    EXPECT_EQ(message({.points = points_, .normals = normals}), "the normal of receiver 3 is not finite");
  }
}

TEST_F(Refused, LightsThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  const auto expect = [&](const LightShape& light, const std::string& what) {
    for (const char* method : {"reference", "hard", "none"})
      EXPECT_NE(message(good_, {.method = method}, light).find("the light's " + what), std::string::npos)
          << what;
  };
  const Vec3 up{0, 4, 0}, down{0, -1, 0};
  for (const double bad : {nan, far}) {
    expect(DiskLight{{0, bad, 0}, down, 0.5}, "center");
    expect(DiskLight{up, {0, bad, 0}, 0.5}, "normal");
    expect(DiskLight{up, down, bad}, "radius");
    expect(RectangleLight{.center = {bad, 0, 0}}, "center");
    expect(RectangleLight{.center = up, .tangent = {bad, 0, 0}}, "tangent");
    expect(RectangleLight{.center = up, .half_extents = {0.5, bad}}, "half extents");
  }
  expect(DiskLight{up, {0, 0, 0}, 0.5}, "normal");
  expect(DiskLight{up, down, -0.5}, "radius");
  expect(RectangleLight{.center = up, .normal = down, .tangent = {0, 2, 0}}, "tangent");
  expect(RectangleLight{.center = up, .half_extents = {0.0, 1.0}}, "half extents");
  EXPECT_EQ(message(good_, {.method = "reference"}, DiskLight{up, down, 0.0}), "not refused");
}

TEST_F(Refused, MethodsAndOptionsThatAreNotThere) {
  EXPECT_NE(message(good_, {.method = "no-method"}).find("no-method"), std::string::npos);
  for (const OptionValue& samples : {OptionValue(std::uint64_t{0}), OptionValue(16.0), OptionValue("many")}) {
    const std::string text = message(good_, {.method = "reference", .options = {{"samples", samples}}});
    EXPECT_NE(text.find("option samples"), std::string::npos) << text;
    EXPECT_NE(text.find("1 to 1048576"), std::string::npos) << text;
  }
}

TEST_F(Refused, LightsAndReceiversThatTheMethodDoesNotTake) {
  register_drawing_methods();
  for (const MethodInfo& method : methods()) {
    const LightShape rectangle = RectangleLight{.center = {0, 4, 0}};
    if (method.needs_pixels) {
      EXPECT_NE(message(good_, {.method = method.name}).find("pixels"), std::string::npos) << method.name;
      continue;
    }
    const std::string text = message(good_, {.method = method.name}, rectangle);
    if (method.takes_rectangles) {
      EXPECT_EQ(text, "not refused") << method.name;
    } else {
      EXPECT_NE(text.find("method " + method.name + " needs a disk"), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace penumbra
