// One Renderer through every method: what was drawn before changes no bit.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "render/d_buffer/d_buffer.h"
#include "render/gl/context.h"
#include "render/gl/functions.h"
#include "render/light/area_light.h"
#include "render/occlusion_textures/occlusion_textures.h"
#include "tests/render/draft_options.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

struct Choice {
  std::string name;
  RenderOptions options;
};

Choice choice(const std::string& name, const std::string& method, const OptionValues& values) {
  RenderOptions options;
  options.method = method;
  options.width = 120;
  options.height = 90;
  // The same picture in less time; what a choice sets comes first.
  options.options = values;
  options.options.insert({{"dbuffer-size", std::uint64_t{256}}, {"texture-size", std::uint64_t{128}}});
  options.options.merge(testing::drafts_of(method));
  return {name, options};
}

/// Methods with the settings that touch OpenGL's state most differently.
std::vector<Choice> choices() {
  register_drawing_methods();
  std::vector<Choice> all;
  for (const MethodInfo& method : methods()) all.push_back(choice(method.name, method.name, {}));
  all.push_back(choice("dbuffer of the paper", "dbuffer",
                       {{"dbuffer", "distances"}, {"conflict", "furthest"}, {"dbuffer-center", "depth"}}));
  all.push_back(choice("dbuffer of two entries", "dbuffer",
                       {{"dbuffer-entries", std::uint64_t{2}}, {"dbuffer-size", std::uint64_t{128}}}));
  all.push_back(choice(
      "occlusion textures with every fix", "occlusion-textures",
      {{"slices", std::uint64_t{4}}, {"thin-fix", "on"}, {"coverage", "area"}, {"slice-faces", "all"}}));
  return all;
}

/// 0 to count - 1, each of them once after each of them, itself included: words a and a b with a < b one
/// after the other.
std::vector<std::size_t> all_neighbors(std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t a = 0; a < count; ++a) {
    order.push_back(a);
    for (std::size_t b = a + 1; b < count; ++b) order.insert(order.end(), {a, b});
  }
  order.push_back(order.front());
  return order;
}

TEST(Renderer, EveryMethodComesAfterEveryOther) {
  const std::vector<std::size_t> order = all_neighbors(7);
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 1; i < order.size(); ++i) pairs.emplace(order[i - 1], order[i]);
  EXPECT_EQ(pairs.size(), 49u);
  EXPECT_EQ(order.size(), 50u);
}

// Every method comes after every other one.
TEST(Renderer, MethodsThatShareItDoNotChangeEachOther) {
  const Scene scene = testing::data_scene("torus-medium");
  const std::vector<Choice> all = choices();
  std::vector<std::map<std::string, std::vector<float>>> fresh;
  for (const Choice& each : all) fresh.push_back(render(scene, each.options).image.channels);
  Renderer shared(scene);
  std::string before = "nothing";
  for (const std::size_t i : all_neighbors(all.size())) {
    EXPECT_EQ(shared.render(all[i].options).image.channels, fresh[i]) << all[i].name << " after " << before;
    before = all[i].name;
  }
}

// Stopped wherever it asks, a frame leaves nothing behind that a later one could see.
TEST(Renderer, FramesCanBeCancelledAnywhere) {
  const Scene scene = testing::data_scene("torus-medium");
  for (Choice each : choices()) {
    const auto fresh = render(scene, each.options).image.channels;
    Renderer renderer(scene);
    int asked = 0, stopped = 0;
    for (int stop_at = 1; stop_at <= asked + 1 && stop_at < 40; ++stop_at) {
      int calls = 0;
      each.options.progress = [&](double) { return ++calls < stop_at; };
      try {
        renderer.render(each.options);
      } catch (const Cancelled&) {
        ++stopped;
      }
      asked = std::max(asked, calls);
      each.options.progress = nullptr;
      EXPECT_EQ(renderer.render(each.options).image.channels, fresh) << each.name << ", " << stop_at;
    }
    EXPECT_GE(stopped, 2) << each.name;
  }
}

/// What the methods change of a context, by OpenGL's names.
std::vector<GLint> state_of(const gl::Functions& gl) {
  std::vector<GLint> values;
  for (const GLenum name : {GL_DEPTH_TEST,
                            GL_DEPTH_FUNC,
                            GL_DEPTH_WRITEMASK,
                            GL_CULL_FACE,
                            GL_CULL_FACE_MODE,
                            GL_CLIP_DISTANCE0,
                            GL_CLIP_DEPTH_MODE,
                            GL_CLIP_ORIGIN,
                            GL_COLOR_LOGIC_OP,
                            GL_LOGIC_OP_MODE,
                            GL_CURRENT_PROGRAM,
                            GL_VERTEX_ARRAY_BINDING,
                            GL_ARRAY_BUFFER_BINDING,
                            GL_DRAW_FRAMEBUFFER_BINDING,
                            GL_READ_FRAMEBUFFER_BINDING,
                            GL_ACTIVE_TEXTURE,
                            GL_TEXTURE_BINDING_2D,
                            GL_TEXTURE_BINDING_2D_ARRAY,
                            GL_TEXTURE_BINDING_BUFFER,
                            GL_PACK_ALIGNMENT,
                            GL_UNPACK_ALIGNMENT,
                            GL_BLEND,
                            GL_STENCIL_TEST,
                            GL_SCISSOR_TEST}) {
    GLint value = -1;
    gl.GetIntegerv(name, &value);
    values.push_back(value);
  }
  EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  return values;
}

TEST(Renderer, MethodsLeaveTheContextAsItWas) {
  const std::unique_ptr<gl::Context> context = gl::make_context(gl::Backend::kOsMesa);
  context->make_current();
  const std::vector<GLint> before = state_of(context->functions());
  const Scene scene = testing::data_scene("torus-medium");
  const testing::View view(scene, 60, 45);
  const LightShape& light = scene.lights.front().shape;
  {
    DBuffer buffer(*context, scene, view.rays);
    buffer.set_surface(view.surface.receivers());
    for (const DBufferOptions& options : {DBufferOptions{.size = 256},
                                          DBufferOptions{.size = 256,
                                          .contents = DBufferContents::kDistances,
                                          .conflict = Conflict::kFurthest,
                                          .center = CenterTest::kDepth},
                                          DBufferOptions{.size = 128, .entries = 2}}) {
      buffer.render(testing::light_of(scene), options);
      EXPECT_EQ(state_of(context->functions()), before) << "D-buffer of " << options.entries << " entries";
    }
  }
  OcclusionTextures textures(*context, scene, view.rays);
  for (const OcclusionOptions& options :
       {OcclusionOptions{.texture_size = 128}, OcclusionOptions{.slices = 4,
                                               .texture_size = 128,
                                               .thin_fix = ThinFix::kOn,
                                               .coverage = SliceCoverage::kArea,
                                               .faces = SliceFaces::kAll}}) {
    textures.render(area_light(light), view.surface.receivers(), options);
    EXPECT_EQ(state_of(context->functions()), before)
        << "occlusion textures of " << options.slices << " slices";
  }
}

// What is kept of the frame before changes no bit either, whatever came between: a renderer finds by itself
// what has changed.
TEST(Renderer, WhatIsKeptChangesNothing) {
  Scene scene = testing::data_scene("torus-medium");
  Renderer keeping(scene);
  const auto expect_same = [&](const Choice& each, const char* after) {
    EXPECT_EQ(keeping.render(each.options).image.channels, render(scene, each.options).image.channels)
        << each.name << ", " << after;
  };
  const std::vector<Choice> all = choices();
  for (const Choice& each : all) expect_same(each, "new");
  for (Choice each : all) {
    each.options.width = 100;
    expect_same(each, "another size");
  }
  scene.camera.eye.y += 0.3;
  keeping.set_camera(scene.camera);
  for (const Choice& each : all) expect_same(each, "another camera");
  testing::light_of(scene).radius *= 1.5;
  keeping.set_light(0, scene.lights[0]);
  for (const Choice& each : all) expect_same(each, "another radius");
  testing::light_of(scene).center.x += 0.2;
  keeping.set_light(0, scene.lights[0]);
  for (const Choice& each : all) expect_same(each, "another place");
  testing::light_of(scene).center.x -= 0.2;
  keeping.set_light(0, scene.lights[0]);
  for (const Choice& each : all) expect_same(each, "the place before");
  keeping.forget();
  for (const Choice& each : all) expect_same(each, "all forgotten");
}

TEST(Renderer, RefusesWhatItsSceneDoesNotHave) {
  Scene scene = testing::data_scene("cube-small");
  Renderer renderer(scene);
  EXPECT_THROW(renderer.set_light(1, scene.lights[0]), UsageError);
  EXPECT_THROW(renderer.shade_again({testing::Values(16, 1.0f)}), UsageError) << "no picture yet";
  scene.lights.clear();
  EXPECT_THROW(Renderer{scene}, UsageError);
  RenderOptions options;
  options.method = "no such method";
  EXPECT_THROW(renderer.render(options), UsageError);
  options.method = "reference";
  options.options = {{"samples", std::uint64_t{0}}};
  EXPECT_THROW(renderer.render(options), UsageError);
}

}  // namespace
}  // namespace penumbra
