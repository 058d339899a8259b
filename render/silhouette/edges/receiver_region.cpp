#include "render/silhouette/edges/receiver_region.h"

namespace penumbra::detail {

PENUMBRA_VECTOR_CLONES
std::size_t keep(const ReceiverRegion& test, const Children* nodes, const NodeMask* in, std::size_t count,
                 NodeMask* out) {
  return keep_with(test, nodes, in, count, out);
}

PENUMBRA_VECTOR_CLONES
std::uint32_t kept_by(const ReceiverRegion::Point& receiver, const Children* nodes, const NodeMask& mask) {
  return mask.kept & ~receiver.dropped(nodes[mask.parent]);
}

}  // namespace penumbra::detail
