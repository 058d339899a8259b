#include "render/silhouette/edges/receiver_region.h"

namespace penumbra::detail {

PENUMBRA_VECTOR_CLONES
std::size_t keep(const Region& test, const Children* nodes, const Siblings* in, std::size_t count,
                 Siblings* out) {
  return keep_with(test, nodes, in, count, out);
}

PENUMBRA_VECTOR_CLONES
std::uint32_t kept_by(const Region::Point& receiver, const Children* nodes, const Siblings& siblings) {
  return siblings.kept & ~receiver.dropped(nodes[siblings.parent]);
}

}  // namespace penumbra::detail
