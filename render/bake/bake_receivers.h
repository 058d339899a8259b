// Bake: means over receivers, what every baked value is. Texels, faces and corners of faces differ in their
// receivers alone.
//
//   quantity     V of each light, or the irradiance of all lights together, red, green and blue
//   mean         Σ weight · quantity / Σ weight over the receivers of a target
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/render/visibility.h"

namespace penumbra {

enum class BakeQuantity {
  /// One channel a light: the fraction of its area that is seen, 0 to 1.
  kVisibility,
  /// Three channels: irradiance, linear RGB, W/m² if a scene unit is a meter; all lights added.
  kIrradiance,
};

/// What all receivers of a bake share. Refers to the casters and the lights.
struct BakeSource {
  const Casters& casters;
  std::span<const Light> lights;
  BakeQuantity quantity = BakeQuantity::kVisibility;
  /// Its progress is not looked at.
  VisibilityOptions visibility{};
  /// Numbers of objects that get their light on the back of their faces: rooms that are one closed mesh,
  /// whose faces look outward once it is read.
  std::vector<std::size_t> backs{};

  std::size_t channels() const { return quantity == BakeQuantity::kIrradiance ? 3 : lights.size(); }
  /// The unit normal on the side that gets light; 0 for a face without area.
  Vec3 normal_of(std::uint32_t object, std::uint32_t face) const;
};

/// Receivers on faces, with the target that each one counts for.
struct BakeReceivers {
  std::vector<Vec3> points{}, normals{};
  std::vector<std::int32_t> objects{};
  std::vector<std::uint32_t> faces{};
  /// Numbers of values, and weights, at least 0.
  std::vector<std::uint32_t> targets{};
  std::vector<double> weights{};

  std::size_t size() const { return points.size(); }
  /// A point of the face at these barycentric coordinates: not moved off the face. `normal`: unit, on the
  /// side that gets light.
  void add(const TriangleMesh& mesh, std::uint32_t object, std::uint32_t face, const Vec3& barycentric,
           const Vec3& normal, std::uint32_t target, double weight);
  /// Refers to this.
  Receivers receivers() const {
    return {.points = points, .normals = normals, .objects = objects, .faces = faces};
  }
};

/// The unit normal of a face by the order of its corners; 0 for a face without area.
Vec3 face_normal(const TriangleMesh& mesh, std::uint32_t face);

/// `targets` means a channel, channel after channel. NaN where the weights of a target add up to 0. Throws as
/// `visibility` does. Cost: one visibility a receiver and light.
std::vector<float> bake_means(const BakeSource& source, const BakeReceivers& receivers, std::size_t targets,
                              const Progress& progress = {});

}  // namespace penumbra
