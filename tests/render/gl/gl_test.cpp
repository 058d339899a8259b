#include <gtest/gtest.h>

#include <glm/vec4.hpp>
#include <set>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "render/gl/context.h"
#include "render/gl/program.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using gl::Object;
using testing::Random;

constexpr gl::Backend kBackends[] = {gl::Backend::kOsMesa, gl::Backend::kEgl};

// One number a column: what the formula named by `formula` makes of the column's inputs.
constexpr const char* kFormulas = R"(#version 450 core
#include "disk_area.glsl"
uniform sampler2D inputs;
uniform int formula;
layout(location = 0) out float result;
vec4 row(int i) { return texelFetch(inputs, ivec2(int(gl_FragCoord.x), i), 0); }
void main() {
  vec4 p = row(0), q = row(1), s = row(2);
  if (formula == 0) result = half_plane_area(p.x);
  if (formula == 1) result = half_plane_area_fast(p.x);
  if (formula == 2) result = two_half_planes_area(Chord(p.xy, p.z), Chord(q.xy, q.z));
  if (formula >= 3) {
    Chord c = chord_of_plane(edge_plane(p.xyz, q.xyz, s.xyz));
    result = formula == 3 ? half_plane_area(c.delta) : formula == 4 ? c.normal.x : c.normal.y;
  }
}
)";
enum Formula { kHalfPlane, kHalfPlaneFast, kTwoHalfPlanes, kVisibilityOfEdge, kNormalX, kNormalY };

/// Three rows of four numbers a column.
struct Inputs {
  std::vector<glm::vec4> rows[3];
  std::size_t size() const { return rows[0].size(); }
  void add(const glm::vec4& p, const glm::vec4& q = glm::vec4(0.0f), const glm::vec4& s = glm::vec4(0.0f)) {
    rows[0].push_back(p);
    rows[1].push_back(q);
    rows[2].push_back(s);
  }
};

constexpr const char* kOneTriangle = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); })";

std::vector<float> run_shader(gl::Context& context, const Inputs& inputs, Formula formula) {
  context.make_current();
  const gl::Functions& gl = context.functions();
  const auto width = static_cast<GLsizei>(inputs.size());
  const gl::Program program(gl, {{GL_VERTEX_SHADER, "one triangle", kOneTriangle},
                                 {GL_FRAGMENT_SHADER, "the test's own", kFormulas}});
  const Object texture(gl, Object::Kind::kTexture), target(gl, Object::Kind::kTexture),
      framebuffer(gl, Object::Kind::kFramebuffer), array(gl, Object::Kind::kVertexArray);
  const auto storage = [&](const Object& of, GLenum format, GLsizei height) {
    gl.BindTexture(GL_TEXTURE_2D, of);
    gl.TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  };
  storage(target, GL_R32F, 1);
  storage(texture, GL_RGBA32F, 3);
  for (int row = 0; row < 3; ++row)
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, row, width, 1, GL_RGBA, GL_FLOAT, inputs.rows[row].data());
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
  gl::require_complete_framebuffer(gl, "running a formula");
  gl.Viewport(0, 0, width, 1);
  gl.BindVertexArray(array);
  program.use();
  gl.Uniform1i(program.uniform("inputs"), 0);
  gl.Uniform1i(program.uniform("formula"), formula);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> out(inputs.size());
  gl.ReadPixels(0, 0, width, 1, GL_RED, GL_FLOAT, out.data());
  gl::require_no_error(gl, "running a formula");
  return out;
}

glm::vec4 to_float(const Vec3& p, double fourth = 0.0) {
  return glm::vec4(glm::dvec4(p, fourth));
}

/// A float chord whose normal is a unit vector as well as float has it, and the same chord in double,
/// normalised.
Chord chord_of(const glm::vec4& p) {
  return {glm::normalize(glm::dvec2(p.x, p.y)), p.z};
}

class GlBackend : public ::testing::TestWithParam<gl::Backend> {
 protected:
  void SetUp() override { context_ = gl::make_context(GetParam()); }
  template <class Truth>
  void expect_same(const Inputs& inputs, Formula formula, double bound, const Truth& truth) {
    const std::vector<float> out = run_shader(*context_, inputs, formula);
    double worst = 0.0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const double expected = truth(i);
      worst = std::max(worst, std::abs(out[i] - expected));
      EXPECT_NEAR(out[i], expected, bound) << "seed " << kSeed << ", column " << i << ", formula " << formula;
      if (HasFailure()) return;
    }
    static constexpr const char* kNames[] = {"half plane", "half plane, fast", "two half planes",
                                             "edge",       "normal x",         "normal y"};
    std::printf("%s, %s: worst difference %.2g\n", gl::name_of(GetParam()), kNames[formula], worst);
  }
  static constexpr std::uint64_t kSeed = 7'041;
  std::unique_ptr<gl::Context> context_;
};
INSTANTIATE_TEST_SUITE_P(Backends, GlBackend, ::testing::ValuesIn(kBackends),
                         [](const auto& backend) { return std::string(gl::name_of(backend.param)); });

TEST_P(GlBackend, IsOpenGl45AndSaysWhatItIs) {
  GLint major = 0, minor = 0;
  context_->functions().GetIntegerv(GL_MAJOR_VERSION, &major);
  context_->functions().GetIntegerv(GL_MINOR_VERSION, &minor);
  EXPECT_GE(10 * major + minor, 45);
  EXPECT_NE(context_->renderer().find(", OpenGL 4."), std::string::npos) << context_->renderer();
}

TEST_P(GlBackend, HalfPlaneAreasAreThoseOfCpp) {
  Random random(kSeed);
  Inputs inputs;
  for (const float delta : {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f, std::numeric_limits<float>::infinity()})
    inputs.add(glm::vec4(delta));
  for (int k = 0; k < 4'000; ++k) {
    const double near = random.spread(1e-8, 1.0);
    inputs.add(glm::vec4(static_cast<float>(k % 2   ? random.uniform(-1.1, 1.1)
                                            : k % 4 ? 1.0 - near
                                                    : near - 1.0)));
  }
  const auto delta = [&](std::size_t i) { return double{inputs.rows[0][i].x}; };
  expect_same(inputs, kHalfPlane, 1e-6, [&](std::size_t i) { return half_plane_area(delta(i)); });
  expect_same(inputs, kHalfPlaneFast, 1e-6, [&](std::size_t i) { return half_plane_area_fast(delta(i)); });
}

TEST_P(GlBackend, TwoHalfPlanesAreaIsThatOfCpp) {
  Random random(kSeed);
  Inputs inputs;
  for (int k = 0; k < 8'000; ++k) {
    const glm::dvec2 n = random.unit2();
    const double turn =
        k % 4 == 0 ? random.uniform(-3.2, 3.2) : random.spread(1e-9, 1e-1) * (k % 8 < 4 ? 1 : -1);
    const double sign = k % 4 < 2 ? 1.0 : -1.0;
    const glm::dvec2 m = sign * (std::cos(turn) * n + std::sin(turn) * glm::dvec2(-n.y, n.x));
    const double delta = random.uniform(-1.0, 1.0);
    const double other =
        k % 4 == 0 ? random.uniform(-1.1, 1.1) : sign * (delta + turn * random.uniform(-1.5, 1.5));
    inputs.add(glm::vec4(n.x, n.y, delta, 0), glm::vec4(m.x, m.y, other, 0));
  }
  for (const float delta : {-1.0f, -0.3f, 0.0f, 0.7f, 1.0f})  // parallel, antiparallel, the same line
    for (const float sign : {1.0f, -1.0f})
      for (const float other : {delta, sign * delta, 0.2f})
        inputs.add(glm::vec4(0.6f, 0.8f, delta, 0), glm::vec4(0.6f * sign, 0.8f * sign, other, 0));
  expect_same(inputs, kTwoHalfPlanes, 1e-5, [&](std::size_t i) {
    return two_half_planes_area(chord_of(inputs.rows[0][i]), chord_of(inputs.rows[1][i]));
  });
}

/// A point of light space where the light's frame, with the disk of radius 1 in z = 0, has p: (x/z, y/z,
/// 1/z).
Vec3 in_light_space(const Vec3& p) {
  return {p.x / p.z, p.y / p.z, 1.0 / p.z};
}
Vec3 in_light_frame(const glm::vec4& p) {
  return {double{p.x} / double{p.z}, double{p.y} / double{p.z}, 1.0 / double{p.z}};
}

// Float is exact to 6e-8 of coordinates up to 4, the plane's normal loses what its sines lose: inputs are
// those where the product of it all stays below 1e-5.
TEST_P(GlBackend, ChordsOfEdgesAreThoseOfCpp) {
  Random random(kSeed);
  Inputs inputs;
  while (inputs.size() < 8'000) {
    const Vec3 x{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(1, 3)};
    const Vec3 a{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.2, 0.8) * x.z};
    const Vec3 b = a + random.uniform(0.1, 1.0) * random.direction();
    if (b.z < 0.2) continue;
    const Vec3 n = edge_plane(in_light_space(x), in_light_space(a), in_light_space(b));
    if (glm::length(n) < 0.2 * glm::length(in_light_space(b) - in_light_space(a)) *
                             glm::length(in_light_space(a) - in_light_space(x)) ||
        std::hypot(n.x, n.y) < 0.3 * glm::length(n))
      continue;
    inputs.add(to_float(in_light_space(x)), to_float(in_light_space(a)), to_float(in_light_space(b)));
  }
  const auto chord = [&](std::size_t i) {
    const Vec3 x = in_light_frame(inputs.rows[0][i]);
    return chord_of_plane(edge_plane(x, in_light_frame(inputs.rows[1][i]), in_light_frame(inputs.rows[2][i])),
                          x, 1.0);
  };
  expect_same(inputs, kVisibilityOfEdge, 1e-5,
              [&](std::size_t i) { return half_plane_area(chord(i).delta); });
  expect_same(inputs, kNormalX, 1e-5, [&](std::size_t i) { return chord(i).normal.x; });
  expect_same(inputs, kNormalY, 1e-5, [&](std::size_t i) { return chord(i).normal.y; });
}

TEST_P(GlBackend, ShaderErrorsAreReportedWithTheCompilersLog) {
  try {
    const gl::Program program(context_->functions(), {{GL_FRAGMENT_SHADER, "broken",
                                                       "#version 450 core\nvoid main() { nonsense; }\n"}});
    FAIL() << "compiled";
  } catch (const SystemError& e) {
    EXPECT_NE(std::string(e.what()).find("broken"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("nonsense"), std::string::npos) << e.what();
  }
}

TEST(GlContexts, OfBothBackendsLiveSideBySide) {
  const auto osmesa = gl::make_context(gl::Backend::kOsMesa);
  const auto egl = gl::make_context(gl::Backend::kEgl);
  Inputs inputs;
  for (int k = 0; k <= 100; ++k) inputs.add(glm::vec4(0.02f * static_cast<float>(k) - 1.0f));
  // Interleaved, with a third context that comes and goes.
  const std::vector<float> first = run_shader(*osmesa, inputs, kHalfPlane);
  const std::vector<float> second = run_shader(*egl, inputs, kHalfPlane);
  { const auto passing = gl::make_context(gl::Backend::kOsMesa); }
  { const auto passing = gl::make_context(gl::Backend::kEgl); }
  const std::vector<float> third = run_shader(*osmesa, inputs, kHalfPlane);
  const std::vector<float> fourth = run_shader(*egl, inputs, kHalfPlane);
  EXPECT_EQ(first, third);
  EXPECT_EQ(second, fourth);
  EXPECT_NEAR(first[50], 0.5f, 1e-6f);
  EXPECT_NEAR(second[50], 0.5f, 1e-6f);
}

TEST(GlContexts, NamesOfBackends) {
  for (const gl::Backend backend : kBackends) EXPECT_EQ(gl::backend_of(gl::name_of(backend)), backend);
  for (const char* name : {"", "glx", "OSMesa", "egl "})
    EXPECT_THROW(gl::backend_of(name), UsageError) << name;
  try {
    gl::backend_of("glx");
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("osmesa or egl"), std::string::npos) << e.what();
  }
}

RenderResult d_buffer_image(const Scene& scene, gl::Backend backend, int threads) {
  RenderOptions options;
  options.width = 160, options.height = 120;
  options.method = "dbuffer";
  options.options = {{"backend", gl::name_of(backend)}, {"dbuffer-size", std::uint64_t{256}}};
  return render(scene, options, threads);
}

TEST(GlContexts, DBufferImagesAreTheSameToTheBit) {
  for (const char* name : {"torus-medium", "boxes-large"}) {
    const Scene scene = testing::data_scene(name);
    const RenderResult one = d_buffer_image(scene, gl::Backend::kOsMesa, 1);
    const std::set<float> values(one.image.at("visibility").begin(), one.image.at("visibility").end());
    EXPECT_GT(values.size(), 500u) << "an image with a penumbra";
    EXPECT_EQ(one.image.channels, d_buffer_image(scene, gl::Backend::kOsMesa, 1).image.channels)
        << name << ", again";
    EXPECT_EQ(one.image.channels, d_buffer_image(scene, gl::Backend::kOsMesa, 2).image.channels)
        << name << ", 2 threads";
    const RenderResult egl = d_buffer_image(scene, gl::Backend::kEgl, 1);
    // Identical where the driver is: both of one Mesa.
    const std::string &renderer = one.lights[0].renderer, &other = egl.lights[0].renderer;
    if (other == renderer) {
      EXPECT_EQ(one.image.channels, egl.image.channels) << name << ", " << renderer;
    } else {
      std::printf("osmesa: %s; egl: %s\n", renderer.c_str(), other.c_str());
      const auto& a = one.image.at("visibility");
      const auto& b = egl.image.at("visibility");
      std::size_t differing = 0;
      for (std::size_t i = 0; i < a.size(); ++i) differing += std::abs(a[i] - b[i]) > 1e-4f;
      EXPECT_LE(differing, a.size() / 500) << name;
    }
  }
}

}  // namespace
}  // namespace penumbra
