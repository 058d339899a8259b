#include "penumbra/volumes/extrude.h"

namespace penumbra {

ShadowMesh extrude_umbra(const TriangleMesh&, const DiskLight&, const Classification&,
                         const ExtrudeOptions&) {
  ShadowMesh result;
  result.guarantee =
      Guarantee::kContained;  // nothing is contained in anything; see penumbra::checks for exact umbras
  return result;
}

}  // namespace penumbra
