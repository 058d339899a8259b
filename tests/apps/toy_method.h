// A method as somebody outside of the library would add one.
#pragma once

#include <memory>

#include "penumbra/render/method.h"

namespace penumbra::test {

/// Every receiver sees the same share of the light.
class ToyMethod : public Method {
  MethodResult run(const MethodInput& input) override {
    MethodResult out;
    for (std::size_t i = 0; i < input.receivers.size(); ++i)
      out.visibility.push_back(
          input.receivers.is_present(i) ? static_cast<float>(real_of(input.options, "toy-share")) : 1.0f);
    out.stages = {{"toy", 0.25}};
    out.counts = {{"toys", std::uint64_t{7}}};
    return out;
  }
};

inline void register_toy() {
  register_method({.name = "toy",
                   .summary = "the same share everywhere",
                   .options = {{.name = "toy-share",
                                .domain = RealRange{0.0, 1.0},
                                .usual = 0.25,
                                .unit = "of the light",
                                .help = "What every receiver sees"}},
                   .make = [](const Scene&) { return std::make_unique<ToyMethod>(); }});
}

/// Once a process.
inline void require_toy() {
  static const bool once = (register_toy(), true);
  static_cast<void>(once);
}

}  // namespace penumbra::test
