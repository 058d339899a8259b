// Silhouette method, before edges are collected: groups of receivers that see all of the light, by boxes
// alone.
//
// In: groups with their boxes, which stay while the receivers do; casters as boxes, which stay as long as
// they; a light. Out: for a group whether all its receivers are in front of the light, have the whole disk
// above their horizons, and no box of a caster between. What would be found receiver by receiver is then
// known: lit. Decided with margins: where rounding may matter the answer is no.
#pragma once

#include <vector>

#include "render/receivers/receiver_box.h"
#include "render/silhouette/caster_boxes.h"
#include "render/silhouette/collect/lit_scene.h"

namespace penumbra::detail {

/// Refers to the groups and to the lit scene.
class LitGroups {
 public:
  /// `horizon`: whether tangent planes hide what lies below them. Only for lights that are not far
  /// (UnitLight): of others no group is known to be lit. Cost O(boxes).
  LitGroups(const BoxedGroups& groups, const CasterBoxes& boxes, const LitScene& lit, bool horizon);
  /// Cost O(casters), and O(boxes) of those near by.
  bool is_lit(std::size_t group) const;

 private:
  /// A box by its middle and half its size.
  struct Box {
    Vec3 middle, half;
    Vec3 low() const { return middle - half; }
    Vec3 high() const { return middle + half; }
  };
  struct Caster {
    Bounds box;
    std::vector<Box> parts;
  };
  /// In the light's frame, around a box of the world.
  Box to_frame(const Bounds& world) const;
  bool has_disk_above(const ReceiverBox& box, const Box& points) const;

  const BoxedGroups& groups_;
  const LitScene& lit_;
  bool horizon_;
  std::vector<Caster> casters_;
};

}  // namespace penumbra::detail
