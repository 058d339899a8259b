#include "render/rays/ray_methods.h"

#include <limits>
#include <numeric>

#include "penumbra/mesh/stage_clock.h"
#include "render/light/light_integrals.h"
#include "render/rays/point_light.h"
#include "render/rays/reference.h"

namespace penumbra {
namespace {

std::vector<std::uint32_t> every_index(const Receivers& receivers) {
  std::vector<std::uint32_t> indices(receivers.size());
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

class ReferenceMethod : public Method {
 public:
  MethodResult run(const MethodInput& input) override {
    StageClock clock;
    ReferenceResult traced =
        trace_reference(input.rays, input.light, input.receivers, every_index(input.receivers),
                        sampling_of(input.options), input.with_unoccluded, input.progress);
    clock.finish("visibility");
    MethodResult out;
    out.visibility = std::move(traced.visibility);
    out.unoccluded = std::move(traced.unoccluded);
    out.stages = clock.stages();
    out.counts = {{"rays", traced.rays},
                  {"mrays_per_second", static_cast<double>(traced.rays) / (1e3 * traced.milliseconds)}};
    return out;
  }
};

class HardMethod : public Method {
 public:
  MethodResult run(const MethodInput& input) override { return hard_shadow(input); }
};

class NoShadowMethod : public Method {
 public:
  MethodResult run(const MethodInput& input) override {
    StageClock clock;
    const AreaLight light = area_light(input.light);
    const Receivers& receivers = input.receivers;
    MethodResult out;
    out.visibility.assign(receivers.size(), 1.0f);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      if (!receivers.is_present(i)) continue;
      if (receivers.has_normals())
        out.visibility[i] =
            static_cast<float>(fraction_above_horizon(light, receivers.points[i], receivers.normals[i]));
      else if (light.is_behind(receivers.points[i]))
        out.visibility[i] = 0.0f;
    }
    clock.finish("visibility");
    out.stages = clock.stages();
    return out;
  }
};

template <class M>
std::unique_ptr<Method> make_alone(const Scene&) {
  return std::make_unique<M>();
}

}  // namespace

std::vector<OptionSchema> sampling_options() {
  const ReferenceOptions usual;
  return {{.name = "samples",
           .domain = IntegerRange{1, 1u << 20},
           .usual = static_cast<std::uint64_t>(usual.samples),
           .unit = "rays a receiver",
           .help = "Rays a receiver, rounded up to ⌊√N⌋ rows of equal length",
           .draft = std::uint64_t{16}},
          {.name = "seed",
           .domain = IntegerRange{0, std::numeric_limits<std::uint64_t>::max()},
           .usual = usual.seed,
           .unit = {},
           .help = "Two seeds give two independent images",
           .steps = std::vector<OptionValue>{}}};
}

std::vector<OptionSchema> dear_sampling_options() {
  std::vector<OptionSchema> options = sampling_options();
  options.front().steps =
      std::vector<OptionValue>{std::uint64_t{64}, std::uint64_t{256}, std::uint64_t{1024}};
  return options;
}

ReferenceOptions sampling_of(const OptionValues& options) {
  return {.samples = static_cast<int>(integer_of(options, "samples")), .seed = integer_of(options, "seed")};
}

MethodInfo reference_method() {
  return {.name = "reference",
          .summary = "stratified rays to the light (Embree), the measure for the others",
          .takes_rectangles = true,
          .takes_distant = true,
          .gives_unoccluded = true,
          .converges = true,
          .options = sampling_options(),
          .make = make_alone<ReferenceMethod>};
}

MethodInfo hard_method() {
  return {.name = "hard",
          .summary = "the hard shadow: one ray to the light's center",
          .takes_rectangles = true,
          .takes_distant = true,
          .gives_unoccluded = true,
          .options = {},
          .make = make_alone<HardMethod>};
}

MethodInfo no_shadow_method() {
  return {.name = "none",
          .summary = "no shadows, only the receiver's horizon",
          .takes_rectangles = true,
          .takes_distant = true,
          .options = {},
          .make = make_alone<NoShadowMethod>};
}

}  // namespace penumbra
