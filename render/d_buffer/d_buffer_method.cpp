#include "render/d_buffer/d_buffer_method.h"

#include "render/d_buffer/d_buffer.h"
#include "render/gl/context_options.h"
#include "render/gl/kept_in_context.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"
#include "render/word_option.h"

namespace penumbra {
namespace {

DBufferOptions options_of(const OptionValues& values) {
  return {.size = static_cast<int>(integer_of(values, "dbuffer-size")),
          .contents = value_in(d_buffer_contents(), word_of(values, "dbuffer")),
          .entries = static_cast<int>(integer_of(values, "dbuffer-entries")),
          .curve = value_in(visibility_curves(), word_of(values, "visibility")),
          .conflict = value_in(conflicts(), word_of(values, "conflict")),
          .center = value_in(center_tests(), word_of(values, "dbuffer-center")),
          .check = value_in(entry_checks(), word_of(values, "dbuffer-check"))};
}

class DBufferMethod : public Method {
 public:
  explicit DBufferMethod(const Scene& objects) : kept_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    StageClock clock;
    WithReceivers& kept = kept_.for_input(input);
    MethodResult out;
    clock.finish("d_buffer");
    out.setup = clock.stages();
    StageClock stages;
    kept.set(input.receivers);
    stages.finish("upload_surface");
    report(input.progress, 0.0);
    DBufferFrame frame = kept.buffer.render(require_circular(input.light, "method dbuffer"),
                                            options_of(input.options), input.progress);
    out.visibility = std::move(frame.visibility);
    out.stages = stages.stages();
    out.stages.insert(out.stages.end(), frame.stages.begin(), frame.stages.end());
    out.counts = std::move(frame.counts);
    out.renderer = kept_.renderer();
    if (input.keep_textures) out.textures = kept.buffer.textures();
    return out;
  }

  void forget() override {
    if (WithReceivers* kept = kept_.get()) {
      kept->revision = 0;
      kept->buffer.forget_light();
    }
  }

 private:
  /// A D-buffer, and which receivers it has.
  struct WithReceivers {
    WithReceivers(gl::Context& context, const Scene& scene, const RayScene& rays)
        : buffer(context, scene, rays) {}

    void set(const Receivers& receivers) {
      if (receivers.revision != 0 && receivers.revision == revision) return;
      revision = 0;  // should it fail half way
      buffer.set_surface(receivers);
      revision = receivers.revision;
    }

    DBuffer buffer;
    std::uint64_t revision = 0;
  };

  gl::KeptInContext<WithReceivers> kept_;
};

}  // namespace

std::vector<OptionSchema> d_buffer_options() {
  const DBufferOptions usual;
  return {
      {.name = "dbuffer-size",
       .domain = IntegerRange{16, 8192, {0}},
       .usual = static_cast<std::uint64_t>(usual.size),
       .unit = "texels",
       .help = "Texels a side of the D-buffer; 0: the root of the picture's pixels",
       .draft = std::uint64_t{256},
       .steps = std::vector<OptionValue>{std::uint64_t{128}, std::uint64_t{256}, std::uint64_t{512},
                                         std::uint64_t{1024}, std::uint64_t{2048}}},
      word_option("dbuffer", d_buffer_contents(), usual.contents,
                  "What a texel keeps: the edge that bounds the penumbra, or the 2004 paper's distances"),
      {.name = "dbuffer-entries",
       .domain = IntegerRange{1, 2},
       .usual = static_cast<std::uint64_t>(usual.entries),
       .unit = {},
       .help = "Entries a texel keeps; two need dbuffer edge and conflict nearest"},
      word_option(
          "visibility", visibility_curves(), usual.curve,
          "Area beyond a chord: exact (of an edge: along the boundary that it is part of), smoothstep "
          "3t²-2t³, or sqrt √t"),
      word_option("conflict", conflicts(), usual.conflict,
                  "Which of several entries on a line of sight is kept"),
      word_option(
          "dbuffer-center", center_tests(), usual.center,
          "How it is told whether the light's center is hidden: by a ray, or by the texel's first surface"),
      word_option("dbuffer-check", entry_checks(), usual.check,
                  "Whether rays are traced where entries contradict each other; with edge, exact and ray"),
      gl::backend_option()};
}

MethodInfo d_buffer_method() {
  return {.name = "dbuffer",
          .summary = "what the light's center sees of penumbra boundaries (OpenGL)",
          .takes_distant = true,
          .needs_pixels = true,
          .needs_opengl = true,
          .options = d_buffer_options(),
          .make = [](const Scene& objects) { return std::make_unique<DBufferMethod>(objects); }};
}

}  // namespace penumbra
