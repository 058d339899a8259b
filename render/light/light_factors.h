// What a light gives to receivers that come one after another: the irradiance factor and the area fraction
// above the horizon of each, as light_integrals.h defines them and bit for bit as it computes them.
//
// Nearly every receiver sees all of a disk or nothing of it. Then both are short formulas without branches,
// which are done for eight receivers at a time. A receiver whose tangent plane cuts the light is left until
// it is asked for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/light/area_light.h"

namespace penumbra::detail {

class LightFactors {
 public:
  /// Receivers, at most.
  static constexpr std::size_t kMost = 64;

  /// Of what follows, for `count` receivers with unit normals.
  void find(const AreaLight& light, const Vec3* points, const Vec3* normals, std::size_t count);

  struct Factors {
    double irradiance, above;
  };
  Factors at(std::size_t i) const { return is_cut_[i] ? of_cut(i) : Factors{irradiance_[i], above_[i]}; }
  bool is_behind(std::size_t i) const { return z_[i] <= 0.0; }

 private:
  using Lanes = std::array<double, kMost>;

  Factors of_cut(std::size_t i) const;

  AreaLight light_;
  /// In the light's frame: points and normals.
  alignas(64) Lanes x_, y_, z_, nx_, ny_, nz_;
  alignas(64) Lanes irradiance_, above_;
  std::array<std::uint8_t, kMost> is_cut_;
};

}  // namespace penumbra::detail
