// The yardstick of visibility: how much of a light a point sees, by many exact rays.
//
// It shares nothing with render/: no header, formula, constant, hierarchy or pattern of samples. Casters are
// the triangles as they are given, in double; nothing is moved, and no tolerance depends on the size of the
// scene.
//
//   blocked   The segment from x to a point of the light is open at both ends. Towards a distant light it is
//             a ray without an end. A face blocks it where the two meet, at an edge or a vertex of the face
//             too. Signs of determinants decide that; they are always right (signs.h).
//   own face  A face whose plane contains x hides nothing. That is so for the faces that the caller names,
//             and for those where double cannot tell x from a point of the plane (side_of_face of signs.h).
//   light     A disk or a rectangle emits to the side of its normal only. Where (x - c)·m ≤ 0, both results
//             are 0. Nothing on or behind its plane casts: every ray ends exactly there.
//   distant   A light that shines in direction m under the angle α is the set of directions -m/|m| + ρ, with
//             ρ perpendicular to m and |ρ| ≤ tan(α/2). Its area is that of this disk. Everything is in front
//             of it.
//   samples   Of a disk, sample k of n lies at radius r·√((k + ½)/n) and angle k·π(3 - √5) + φ(seed): Vogel's
//             spiral. Of a rectangle it lies at k·(a, a²) + φ(seed), modulo 1, with a³ + a² = 1 (Roberts,
//             2018). Rays end at the sample, rounded to double: an error of 2^-53 of the light's coordinates,
//             or of a direction of length 1.
//   error     The share of samples on one side of a line through the disk is off by .0044 / .0016 / .00055
//             RMS and by .022 / .008 / .0024 at most for 256 / 1,024 / 4,096 samples, over 24,000 random
//             lines or more. It falls with the power 3/4 of their number. For a line through a rectangle it
//             is .0023 RMS for 1,024 samples.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"
#include "tests/oracle/signs.h"

namespace penumbra::oracle {

/// A flat rectangle with the corners center ± u ± v, u perpendicular to v. It shines towards u × v.
struct Rectangle {
  Vec3 center, u, v;
};
using Light = std::variant<DiskLight, DistantLight, Rectangle>;

/// A face of one of the casters, by its index in the span.
struct CasterFace {
  std::uint32_t object = 0;
  FaceId face{};

  bool operator==(const CasterFace&) const = default;
};

/// The samples of a light, each of the same area: points or, of a distant light, directions towards it. At
/// radius 0 all are its center. Requires samples ≥ 1.
std::vector<Vec3> light_samples(const Light& light, int samples, std::uint64_t seed);

/// Where a ray meets a face: at start + distance·direction.
struct Hit {
  CasterFace face;
  double distance = 0.0;
};

class Oracle {
 public:
  /// Copies what it needs of the casters. O(F log² F) for F faces.
  explicit Oracle(std::span<const TriangleMesh> casters);

  /// O(x): the fraction of the disk's area that no face hides from x. `own` are the faces that x lies on; it
  /// may be empty. Seeds rotate the samples: points that are averaged over should each have their own.
  double unoccluded(const Vec3& x, std::span<const CasterFace> own, const Light& light, int samples,
                    std::uint64_t seed) const;

  /// V(x): the fraction that is also above the tangent plane, N·(p - x) > 0. `normal`, of any length but 0,
  /// points to the side that is looked at.
  double visibility(const Vec3& x, const Vec3& normal, std::optional<CasterFace> own, const Light& light,
                    int samples, std::uint64_t seed) const;

  /// Whether a face hides the light point q from x; of a distant light q is the direction towards the point.
  /// x must lie in front of the light's plane.
  bool blocked(const Vec3& x, const Vec3& q, std::span<const CasterFace> own, const Light& light) const;
  /// The same without the hierarchy: looks at all faces.
  bool blocked_by_any(const Vec3& x, const Vec3& q, std::span<const CasterFace> own,
                      const Light& light) const;

  /// The first face that a ray without an end meets, as a camera sees it. Which faces are met is exact; their
  /// order is that of distances, rounded. Nothing where none is met.
  std::optional<Hit> first_hit(const Vec3& start, const Vec3& direction) const;

 private:
  struct Triangle {
    Vec3 a, b, c;
    CasterFace id;
  };
  /// A leaf has a `count` of triangles from `first`. An inner node has its children at the next place and at
  /// `first`.
  struct Node {
    Bounds bounds;
    std::uint32_t first = 0, count = 0;
  };

  void build(std::size_t begin, std::size_t end);
  /// Calls `visit` for triangles, all that the ray meets among them, until it returns false. `end` is a
  /// parameter of the ray, beyond which boxes are left out; `visit` may lower it.
  template <class Visit>
  void walk(const Vec3& start, const Vec3& direction, double& end, const Visit& visit) const;
  /// One of the faces that block the ray, or null. `likely` is looked at first, if there is one.
  const Triangle* blocker(const Ray& ray, std::span<const CasterFace> own, const Triangle* likely) const;
  template <class Accept>
  double share(const Vec3& x, std::span<const CasterFace> own, const Light& light, int samples,
               std::uint64_t seed, const Accept& accept) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace penumbra::oracle
