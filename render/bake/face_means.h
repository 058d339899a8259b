// Bake: means over the faces of an object, or around its vertices.
//
//   over a face       ∫ q dA / ∫ dA over the face
//   around a vertex   ∫ h q dA / ∫ h dA over the faces at the vertex, with h linear on each, 1 at the vertex
//                     and 0 at its other corners: the values that a renderer interpolates between vertices
//
// Integrals are sums over the centers of side² triangles, into which each face is divided.
#pragma once

#include <functional>
#include <vector>

#include "penumbra/render/bake/bake_receivers.h"

namespace penumbra {

enum class BakePlace { kFaces, kVertices };

struct FaceMeansOptions {
  BakePlace place = BakePlace::kFaces;
  /// Each face is divided into side² triangles of one shape. 1 to 64.
  int side = 4;
  /// Faces of a part, which is baked at once.
  std::size_t part = 4096;
};

/// Refers to the source. One call of `bake` at a time.
class FaceMeans {
 public:
  /// Throws UsageError for options outside of their domain and for an object that is not there.
  FaceMeans(const BakeSource& source, std::size_t object, const FaceMeansOptions& options = {});

  std::size_t parts() const;
  /// How many faces the part has.
  std::size_t faces(std::size_t part) const;
  /// Values of a part, for `finish`. The same wherever and whenever it is called. Throws as `visibility`
  /// does.
  std::vector<float> bake(std::size_t part, const Progress& progress = {}) const;
  /// How many values that are.
  std::size_t values(std::size_t part) const;
  /// One list a channel, one value a face or vertex in the mesh's order; NaN where there is no area.
  /// `values_of(part)` gives what `bake` gave. Throws UsageError for values of another number.
  std::vector<std::vector<float>> finish(
      const std::function<std::vector<float>(std::size_t part)>& values_of) const;

 private:
  const TriangleMesh& mesh() const { return source_.casters.objects()[object_].mesh; }
  /// Values of a face.
  std::size_t each() const { return options_.place == BakePlace::kFaces ? 1 : 3; }

  const BakeSource& source_;
  std::size_t object_;
  FaceMeansOptions options_;
};

/// All parts, one after the other.
std::vector<std::vector<float>> bake_faces(const BakeSource& source, std::size_t object,
                                           const FaceMeansOptions& options = {},
                                           const Progress& progress = {});

}  // namespace penumbra
