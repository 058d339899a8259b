// Types that every module shares: points, strong ids, indexed triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

namespace penumbra {

/// A point or vector in scene units, double precision.
using Vec3 = glm::dvec3;

/// Strong ids: indices into the arrays of one TriangleMesh. `index(id)` gives the plain number.
enum class VertexId : std::uint32_t {};
enum class EdgeId : std::uint32_t {};
enum class FaceId : std::uint32_t {};

template <class Id>
constexpr std::size_t index(Id id) {
  return static_cast<std::size_t>(id);
}

/// "No such element", for example the face beyond a boundary edge.
template <class Id>
inline constexpr Id kNone = Id{std::numeric_limits<std::uint32_t>::max()};

/// Three indices, counter-clockwise seen from outside.
using IndexedTriangle = std::array<std::uint32_t, 3>;

}  // namespace penumbra
