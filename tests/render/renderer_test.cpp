// One Renderer through every method: what was drawn before changes no bit.
#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "render/gl/context.h"
#include "render/gl/functions.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

struct Choice {
  std::string name;
  RenderOptions options;
};

/// Methods with the settings that touch OpenGL's state most differently.
std::vector<Choice> choices() {
  RenderOptions base;
  base.width = 120;
  base.height = 90;
  base.d_buffer.size = 256;
  base.occlusion.texture_size = 128;
  base.reference.samples = 16;
  std::vector<Choice> all;
  for (const std::string& method : method_names()) {
    base.method = method_of(method);
    all.push_back({method, base});
  }
  RenderOptions paper = base;
  paper.method = Method::kDBuffer;
  paper.d_buffer.contents = DBufferContents::kDistances;
  paper.d_buffer.conflict = Conflict::kFurthest;
  paper.d_buffer.center = CenterTest::kDepth;
  all.push_back({"dbuffer of the paper", paper});
  RenderOptions two = base;
  two.method = Method::kDBuffer;
  two.d_buffer.entries = 2;
  two.d_buffer.size = 128;
  all.push_back({"dbuffer of two entries", two});
  RenderOptions fixed = base;
  fixed.method = Method::kOcclusionTextures;
  fixed.occlusion.slices = 4;
  fixed.occlusion.thin_fix = ThinFix::kOn;
  fixed.occlusion.coverage = SliceCoverage::kArea;
  fixed.occlusion.faces = SliceFaces::kAll;
  all.push_back({"occlusion textures with every fix", fixed});
  return all;
}

// Every method comes after every other one.
TEST(Renderer, MethodsThatShareItDoNotChangeEachOther) {
  const Scene scene = testing::data_scene("torus-medium");
  const std::vector<Choice> all = choices();
  std::vector<std::map<std::string, std::vector<float>>> fresh;
  for (const Choice& each : all) fresh.push_back(render(scene, each.options).image.channels);
  Renderer shared(scene, all.front().options);
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b) {
      shared.render_frame(all[a].options);
      EXPECT_EQ(shared.render_frame(all[b].options).image.channels, fresh[b])
          << all[b].name << " after " << all[a].name;
    }
}

// Stopped wherever it asks, a frame leaves nothing behind that a later one could see.
TEST(Renderer, FramesCanBeCancelledAnywhere) {
  const Scene scene = testing::data_scene("torus-medium");
  for (Choice each : choices()) {
    const auto fresh = render(scene, each.options).image.channels;
    Renderer renderer(scene, each.options);
    int asked = 0, stopped = 0;
    for (int stop_at = 1; stop_at <= asked + 1 && stop_at < 40; ++stop_at) {
      int calls = 0;
      each.options.progress = [&](double) { return ++calls < stop_at; };
      try {
        renderer.render_frame(each.options);
      } catch (const Cancelled&) {
        ++stopped;
      }
      asked = std::max(asked, calls);
      each.options.progress = nullptr;
      EXPECT_EQ(renderer.render_frame(each.options).image.channels, fresh) << each.name << ", " << stop_at;
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
  for (const Choice& each : choices()) {
    if (each.options.method == Method::kDBuffer) {
      DBuffer buffer(*context, scene, view.rays);
      buffer.set_surface(view.surface);
      buffer.render(scene.light, each.options.d_buffer);
    } else if (each.options.method == Method::kOcclusionTextures) {
      OcclusionTextures textures(*context, scene, view.rays);
      textures.render(area_light(scene), view.surface, each.options.occlusion);
    } else {
      continue;
    }
    EXPECT_EQ(state_of(context->functions()), before) << each.name;
  }
}

// What is kept of the frame before changes no bit either, whatever came between.
TEST(Renderer, WhatIsReusedChangesNothing) {
  Scene scene = testing::data_scene("torus-medium");
  Renderer keeping(scene, choices().front().options);
  const auto expect_same = [&](const Choice& each) {
    RenderOptions options = each.options;
    const auto fresh = render(scene, options).image.channels;
    options.reuse = true;
    EXPECT_EQ(keeping.render_frame(options).image.channels, fresh) << each.name;
  };
  for (const Choice& each : choices()) expect_same(each);
  for (Choice each : choices()) {
    each.options.width = 100;
    expect_same(each);
  }
  scene.camera.eye.y += 0.3;
  for (const Choice& each : choices()) expect_same(each);
  scene.light.radius *= 1.5;
  for (const Choice& each : choices()) {
    RenderOptions options = each.options;
    options.reuse = true;
    keeping.render_frame(options);  // the same rays' frame: no bits are promised, but nothing stale may stay
  }
  scene.light.center.x += 0.2;
  keeping.follow_light(choices().front().options);
  for (const Choice& each : choices()) expect_same(each);
}

}  // namespace
}  // namespace penumbra
