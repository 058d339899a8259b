#include "render/occlusion_textures/occlusion_textures_method.h"

#include <limits>

#include "render/gl/context_options.h"
#include "render/gl/kept_in_context.h"
#include "render/occlusion_textures/occlusion_textures.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"
#include "render/word_option.h"

namespace penumbra {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::optional<double> cop_offset_of(const OptionValues& values) {
  const OptionValue& value = values.find("cop-offset")->second;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (std::get<std::string>(value) == "orthographic") return kInfinity;
  return std::nullopt;
}

OcclusionOptions options_of(const OptionValues& values) {
  return {.slices = static_cast<int>(integer_of(values, "slices")),
          .texture_size = static_cast<int>(integer_of(values, "texture-size")),
          .filter = value_in(occlusion_filters(), word_of(values, "filter")),
          .combine = value_in(occlusion_combines(), word_of(values, "combine")),
          .kernel = value_in(occlusion_kernels(), word_of(values, "kernel")),
          .thin_fix = value_in(thin_fixes(), word_of(values, "thin-fix")),
          .range = value_in(slice_ranges(), word_of(values, "slice-range")),
          .coverage = value_in(slice_coverages(), word_of(values, "coverage")),
          .faces = value_in(slice_faces(), word_of(values, "slice-faces")),
          .cop_offset = cop_offset_of(values)};
}

class OcclusionTexturesMethod : public Method {
 public:
  explicit OcclusionTexturesMethod(const Scene& objects) : kept_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    StageClock clock;
    MethodResult out;
    OcclusionTextures& textures = kept_.for_input(input);
    clock.finish("occlusion_textures");
    out.setup = clock.stages();
    OcclusionFrame frame =
        textures.render(area_light(input.light), input.receivers, options_of(input.options), input.progress);
    out.visibility = std::move(frame.visibility);
    out.stages = std::move(frame.stages);
    out.counts = std::move(frame.counts);
    out.renderer = kept_.renderer();
    if (input.keep_textures) out.textures = std::move(frame.textures);
    return out;
  }

 private:
  gl::KeptInContext<OcclusionTextures> kept_;
};

}  // namespace

std::vector<OptionSchema> occlusion_options() {
  const OcclusionOptions usual;
  return {
      {.name = "slices",
       .domain = IntegerChoice{{4, 8, 12, 16}},
       .usual = static_cast<std::uint64_t>(usual.slices),
       .unit = "slices",
       .help = "Slices of the scene"},
      {.name = "texture-size",
       .domain = IntegerChoice{{128, 256, 512, 1024}},
       .usual = static_cast<std::uint64_t>(usual.texture_size),
       .unit = "texels",
       .help = "Texels a side of each slice"},
      word_option("filter", occlusion_filters(), usual.filter, "How a slice is averaged over the light"),
      word_option("combine", occlusion_combines(), usual.combine, "How slices add up"),
      word_option("kernel", occlusion_kernels(), usual.kernel,
                  "A disk light as one square of equal area or as strips"),
      word_option("thin-fix", thin_fixes(), usual.thin_fix,
                  "Draw each slice into the next one too; auto: for open and thin objects"),
      word_option("slice-range", slice_ranges(), usual.range,
                  "Depths that are sliced: of all or of casters; auto: of casters where they nearly touch a "
                  "receiver"),
      word_option("coverage", slice_coverages(), usual.coverage,
                  "Texels by their centers or by eight samples"),
      word_option("slice-faces", slice_faces(), usual.faces,
                  "Which faces of closed casters are drawn: all, or what faces the light"),
      {.name = "cop-offset",
       .domain = RealRange{0.0, kInfinity, false, {"auto", "orthographic"}},
       .usual = std::string("auto"),
       .unit = "scene units",
       .help =
           "Distance of the center of projection behind the light; auto: as far as the frustum contains the "
           "casters"},
      gl::backend_option()};
}

MethodInfo occlusion_textures_method() {
  return {.name = "occlusion-textures",
          .summary = "prefiltered slices parallel to the light (OpenGL), for comparison",
          .takes_rectangles = true,
          .takes_distant = true,
          .needs_pixels = true,
          .needs_opengl = true,
          .options = occlusion_options(),
          .make = [](const Scene& objects) { return std::make_unique<OcclusionTexturesMethod>(objects); }};
}

}  // namespace penumbra
