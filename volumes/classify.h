// Classify: which faces look at the whole light, at none of it, or at a part of it.
//
// In: a mesh and a light, a disk or a distant one. Out: a class per face. "Umbra and penumbra volumes"
// (2004), section 2.1, with eq. 1 corrected: its vector has the wrong sign and length. Here the class is a
// polynomial's sign, see predicates.h.
#pragma once

#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"
#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra {

/// How many faces each tier of arithmetic decided.
struct TierTally {
  std::size_t filter = 0, interval = 0, exact = 0;
};

struct Classification {
  /// One class per face of the mesh.
  std::vector<FaceClass> faces;
  /// How many faces have each class.
  std::size_t all_front = 0, mixed = 0, none_front = 0;
  TierTally tally;
};

/// Classifies every face exactly. A face whose plane touches the disk is mixed, and so is one without area.
/// Mesh and light are in the same frame. Deterministic, on all cores from some thousand faces on. Cost O(F).
Classification classify_faces(const TriangleMesh& mesh, const CircularLight& light);

}  // namespace penumbra
