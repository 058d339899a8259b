// The yardstick of visibility: how much of a disk light a point sees, by many exact rays.
//
// It shares nothing with render/: no header, formula, constant, hierarchy or pattern of samples. Casters are the
// triangles as they are given, in double; nothing is moved, and no tolerance depends on the size of the scene.
//
//   blocked   The segment from x to a point of the light is open at both ends. A face blocks it where the two meet, at
//             an edge or a vertex of the face too. Signs of determinants decide that; they are always right (signs.h).
//   own face  A face whose plane contains x hides nothing. That is so for the faces that the caller names, and for
//             those where double cannot tell x from a point of the plane (side_of_face of signs.h).
//   light     It emits to the side of its normal only. Where (x - c)·m ≤ 0, both results are 0. Nothing on or behind its
//             plane casts: every ray ends exactly there.
//   samples   Sample k of n lies at radius r·√((k + ½)/n) and angle k·π(3 - √5) + φ(seed): Vogel's spiral. Rays end at
//             the sample, rounded to double: an error of 2^-53 of the light's coordinates.
//   error     The share of samples on one side of a line through the disk is off by .0044 / .0016 / .00055 RMS and by
//             .022 / .008 / .0024 at most for 256 / 1,024 / 4,096 samples, over 24,000 random lines or more. It falls
//             with the power 3/4 of their number.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::oracle {

/// A face of one of the casters, by its index in the span.
struct CasterFace {
  std::uint32_t object = 0;
  FaceId face{};

  bool operator==(const CasterFace&) const = default;
};

/// The samples of a light, each of the same area. At radius 0 all are its center. Requires samples ≥ 1.
std::vector<Vec3> light_samples(const DiskLight& light, int samples, std::uint64_t seed);

class Oracle {
 public:
  /// Copies what it needs of the casters. O(F log² F) for F faces.
  explicit Oracle(std::span<const TriangleMesh> casters);

  /// O(x): the fraction of the disk's area that no face hides from x. `own` are the faces that x lies on; it may be
  /// empty. Seeds rotate the samples: points that are averaged over should each have their own.
  double unoccluded(const Vec3& x, std::span<const CasterFace> own, const DiskLight& light, int samples,
                    std::uint64_t seed) const;

  /// V(x): the fraction that is also above the tangent plane, N·(p - x) > 0. `normal`, of any length but 0, points to
  /// the side that is looked at.
  double visibility(const Vec3& x, const Vec3& normal, std::optional<CasterFace> own, const DiskLight& light,
                    int samples, std::uint64_t seed) const;

  /// Whether a face hides the light point q from x. x must lie in front of the light's plane.
  bool blocked(const Vec3& x, const Vec3& q, std::span<const CasterFace> own, const DiskLight& light) const;
  /// The same without the hierarchy: looks at all faces.
  bool blocked_by_any(const Vec3& x, const Vec3& q, std::span<const CasterFace> own,
                      const DiskLight& light) const;

 private:
  struct Triangle {
    Vec3 a, b, c;
    CasterFace id;
  };
  /// A leaf has a `count` of triangles from `first`. An inner node has its children at the next place and at `first`.
  struct Node {
    Bounds bounds;
    std::uint32_t first = 0, count = 0;
  };

  void build(std::size_t begin, std::size_t end);
  template <class Accept>
  double share(const Vec3& x, std::span<const CasterFace> own, const DiskLight& light, int samples,
               std::uint64_t seed, const Accept& accept) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace penumbra::oracle
