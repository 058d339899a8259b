#include "render/view_samples/face_tree.h"

#include <algorithm>

#include "mesh/vectors.h"
#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

struct Place {
  std::array<double, 3> at;
  std::uint32_t number;
};

}  // namespace

FaceTree::FaceTree(const Scene& scene, const UnitLight& unit, const std::vector<char>& left_out) {
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.casts || (!left_out.empty() && left_out[i] != 0)) continue;
    std::vector<Vec3> points;
    points.reserve(object.mesh.positions().size());
    for (const Vec3& p : object.mesh.positions()) points.push_back(unit.point(p));
    for (std::uint32_t f = 0; f < object.mesh.triangles().size(); ++f) {
      const IndexedTriangle& t = object.mesh.triangles()[f];
      LitFace face{{points[t[0]], points[t[1]], points[t[2]]}, {}, i, f};
      for (const Vec3& p : {face.corners.a, face.corners.b, face.corners.c}) face.box.add(p);
      if (!(face.box.high.z > 0.0)) continue;
      extent_ = std::max({extent_, largest_component(face.box.low), largest_component(face.box.high)});
      faces_.push_back(face);
    }
  }
  build();
}

void FaceTree::build() {
  if (faces_.empty()) return;
  std::vector<Place> places;
  for (std::uint32_t i = 0; i < faces_.size(); ++i) {
    const Vec3 middle = faces_[i].box.center();
    places.push_back({{middle.x, middle.y, middle.z}, i});
  }
  order_by_place<ByNumberThenAll>(places.data(), places.data() + places.size(), kLeaf);
  std::vector<LitFace> ordered;
  ordered.reserve(faces_.size());
  for (const Place& place : places) ordered.push_back(faces_[place.number]);
  faces_ = std::move(ordered);

  std::vector<Bounds> level;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (i % kLeaf == 0) level.emplace_back();
    level.back().add(faces_[i].box);
  }
  levels_.push_back(std::move(level));
  while (levels_.back().size() > 1) {
    std::vector<Bounds> above((levels_.back().size() + 1) / 2);
    for (std::size_t i = 0; i < levels_.back().size(); ++i) above[i / 2].add(levels_.back()[i]);
    levels_.push_back(std::move(above));
  }
}

void FaceTree::collect(const Shaft& shaft, std::vector<std::uint32_t>& out) const {
  out.clear();
  if (levels_.empty()) return;
  struct Node {
    std::size_t level, place;
  };
  // Depth first: at most one node a level waits, and one more.
  std::array<Node, 128> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {levels_.size() - 1, 0};
  while (waiting > 0) {
    const Node node = stack[--waiting];
    const Bounds& box = levels_[node.level][node.place];
    if (shaft.misses(box.low, box.high)) continue;
    if (node.level > 0) {
      const std::size_t first = 2 * node.place;
      if (first + 1 < levels_[node.level - 1].size()) stack[waiting++] = {node.level - 1, first + 1};
      stack[waiting++] = {node.level - 1, first};
      continue;
    }
    const std::size_t first = node.place * kLeaf;
    for (std::size_t i = first; i < std::min(first + kLeaf, faces_.size()); ++i)
      if (!shaft.misses(faces_[i].box.low, faces_[i].box.high)) out.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace penumbra::detail
