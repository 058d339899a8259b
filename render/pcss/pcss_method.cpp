#include "render/pcss/pcss_method.h"

#include "render/pcss/pcss.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace {

PcssOptions options_of(const OptionValues& values) {
  return {.map_size = static_cast<int>(integer_of(values, "map-size")),
          .search_samples = static_cast<int>(integer_of(values, "search-samples")),
          .filter_samples = static_cast<int>(integer_of(values, "filter-samples")),
          .bias = detail::bias_of(values),
          .receiver_plane = word_of(values, "receiver-plane") == "on"};
}

class PcssMethod : public Method {
 public:
  explicit PcssMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    return pcss_visibility(scene_, area_light(input.light), input.receivers, options_of(input.options),
                           input.keep_textures, input.rays.arena(), input.progress);
  }

 private:
  const Scene& scene_;
};

std::vector<OptionSchema> options() {
  const PcssOptions usual;
  const auto samples = [](const char* name, int count, const char* help) {
    return OptionSchema{
        .name = name,
        .domain = IntegerRange{1, 4096},
        .usual = static_cast<std::uint64_t>(count),
        .unit = "samples a receiver",
        .help = help,
        .draft = std::uint64_t{16},
        .steps = std::vector<OptionValue>{std::uint64_t{16}, std::uint64_t{64}, std::uint64_t{256}}};
  };
  std::vector<OptionSchema> out{
      detail::map_size_option(),
      samples("search-samples", usual.search_samples, "Texels at which blockers are looked for"),
      samples("filter-samples", usual.filter_samples, "Texels that are compared with the receiver")};
  for (OptionSchema& bias : detail::bias_options()) out.push_back(std::move(bias));
  out.push_back({.name = "receiver-plane",
                 .domain = WordChoice{{"on", "off"}},
                 .usual = std::string(usual.receiver_plane ? "on" : "off"),
                 .unit = {},
                 .help = "Compare samples with the plane of the receiver, or with its point"});
  return out;
}

}  // namespace

MethodInfo pcss_method() {
  return {.name = "pcss",
          .summary = "blockers and percentages in a shadow map of the light's center, as games have it",
          .takes_rectangles = true,
          .takes_distant = true,
          .options = options(),
          .make = [](const Scene& objects) { return std::make_unique<PcssMethod>(objects); }};
}

}  // namespace penumbra
