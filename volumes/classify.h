// Pipeline step 1: which faces look at the whole light, at none of it, or at a part.
//
// In: mesh and light. Out: a class per face. "Umbra and penumbra volumes" (2004), section 2.1, with eq. 1
// corrected: see predicates.h.
#pragma once

#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"
#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra {

/// Which tier of arithmetic decided, counted over faces.
struct TierTally {
  std::size_t filter = 0, interval = 0, exact = 0;
};

struct Classification {
  std::vector<FaceClass> faces;  ///< one per face of the mesh
  std::size_t all_front = 0, mixed = 0, none_front = 0;
  TierTally tally;
};

/// Cost O(F), on all cores above some thousand faces. Deterministic.
Classification classify_faces(const TriangleMesh& mesh, const DiskLight& light);

}  // namespace penumbra
