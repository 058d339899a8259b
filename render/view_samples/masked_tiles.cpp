#include "render/view_samples/masked_tiles.h"

#include <algorithm>

#include "mesh/vectors.h"
#include "render/receivers/sample_key.h"

namespace penumbra::detail {
namespace {

// Speed. Shorter lists are not narrowed for parts of a tile, and longer ones for so many receivers at a time.
constexpr std::size_t kShortList = 16, kFewReceivers = 4;

}  // namespace

void MaskedTiles::answer(std::size_t group, MaskWorkspace& w) const {
  source_.collect(group, w.tile);
  if (w.tile.empty()) return;
  w.counts.receivers += w.tile.size();
  List list;
  faces_.collect(shaft_of(w.tile), list);
  divide(w.tile, list, w);
}

Shaft MaskedTiles::shaft_of(std::span<const TileReceiver> part) const {
  double extent = faces_.extent();
  for (const TileReceiver& receiver : part) extent = std::max(extent, largest_component(receiver.x));
  Shaft shaft(part, extent);
  shaft.tighten(part);
  return shaft;
}

void MaskedTiles::divide(std::span<TileReceiver> part, const List& list, MaskWorkspace& w) const {
  if (list.size() <= kShortList || part.size() <= kFewReceivers) {
    for (const TileReceiver& receiver : part) visibility_[receiver.index] = visible_to(receiver, list, w);
    return;
  }
  const std::size_t middle = halve(part);
  for (const std::span<TileReceiver> half : {part.first(middle), part.subspan(middle)}) {
    const Shaft shaft = shaft_of(half);
    List narrowed;
    for (const std::uint32_t number : list) {
      const Bounds& box = faces_.face(number).box;
      if (!shaft.misses(box.low, box.high)) narrowed.push_back(number);
    }
    divide(half, narrowed, w);
  }
}

/// The face on which the receiver lies, and others in whose plane it lies as far as double can tell.
bool MaskedTiles::hides_nothing(const LitFace& face, const FaceCone& cone, std::uint32_t receiver) const {
  const Receivers& all = call_.receivers;
  if (!all.faces.empty() && !all.objects.empty() && all.faces[receiver] == face.face &&
      all.objects[receiver] == static_cast<std::int32_t>(face.object))
    return true;
  if (cone.depth > cone.depth_error) return false;
  const TriangleMesh& mesh = call_.scene.objects[face.object].mesh;
  const IndexedTriangle& t = mesh.triangles()[face.face];
  return side_of_plane({mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]},
                       all.points[receiver]) == 0;
}

float MaskedTiles::visible_to(const TileReceiver& receiver, const List& list, MaskWorkspace& w) const {
  const std::uint32_t i = receiver.index;
  bool has_begun = false;
  const auto begin = [&] {
    if (has_begun) return;
    has_begun = true;
    w.masks.begin({.x = receiver.x,
                   .to_center = call_.light.from_receiver(call_.receivers.points[i]),
                   .normal = call_.options.horizon ? call_.receivers.normals[i] : Vec3(0.0),
                   .key = sample_key_of(call_.receivers, i, call_.options.seed)});
  };
  for (const std::uint32_t number : list) {
    const LitFace& face = faces_.face(number);
    const FaceCone cone(face.corners, receiver.x);
    ++w.counts.listed_faces;
    const Cover cover = cone.cover(receiver.x);
    if (cover == Cover::kNone || hides_nothing(face, cone, i)) continue;
    if (cover == Cover::kAll) {
      ++w.counts.covers;
      return 0.0f;
    }
    begin();
    ++w.counts.masks;
    if (!w.masks.hide(cone)) return 0.0f;
  }
  if (!has_begun && !receiver.horizon_cuts) return 1.0f;
  begin();
  return static_cast<float>(w.masks.visible()) * (1.0f / static_cast<float>(w.masks.count()));
}

}  // namespace penumbra::detail
