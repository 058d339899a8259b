#include "render/shadow_volumes/volume_counter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Speed. Lines run towards the light, so that they leave volumes by their caps and sides near the casters,
/// but askew to its axes, since a line along a side would graze it. Small: sides seen along the line are
/// short.
constexpr double kAskewU = 0.1303, kAskewV = 0.0717;
/// Accuracy. Boxes are larger by that, times the largest coordinate.
constexpr double kRounding = 0x1p-40;

double det(const Vec3& a, const Vec3& b, const Vec3& d) {
  return glm::dot(glm::cross(a, b), d);
}

bool is_negative(double x) {
  return x < 0.0;
}

/// Whether a line through the origin along d passes within the triangle, and which way: the sign of d·normal;
/// else 0.
int passes(const FaceCorners& t, const Vec3& x, const Vec3& d) {
  const Vec3 a = t.a - x, b = t.b - x, c = t.c - x;
  const bool ab = is_negative(det(a, b, d)), bc = is_negative(det(b, c, d)), ca = is_negative(det(c, a, d));
  if (ab != bc || bc != ca) return 0;
  return ab ? -1 : 1;
}

}  // namespace

void VolumeCounter::Box::add(const Box& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], other.low[k]);
    high[k] = std::max(high[k], other.high[k]);
  }
}

Vec3 VolumeCounter::across(const Vec3& p) const {
  return {glm::dot(p, u_), glm::dot(p, v_), glm::dot(p, along_)};
}

VolumeCounter::Box VolumeCounter::box_around(std::initializer_list<Vec3> points) const {
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const Vec3& p : points) {
    const Vec3 q = across(p);
    box.add({{q.x, q.y, q.z}, {q.x, q.y, q.z}});
  }
  return box;
}

/// To infinity, in a direction.
void VolumeCounter::stretch(Box& box, const Vec3& direction) const {
  const Vec3 way = across(direction);
  const double parts[3] = {way.x, way.y, way.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if (parts[k] < 0.0) box.low[k] = -kInfinity;
    if (parts[k] > 0.0) box.high[k] = kInfinity;
  }
}

/// Makes the box hold the side down to the deepest receiver, or to infinity. False where all of it is deeper.
bool VolumeCounter::clamp_side(const VolumeSide& side, bool clamp, Box& box) const {
  bool reaches = false;
  for (const Vec3& p : {side.a, side.b}) {
    const double depth = glm::dot(light_.distant ? p : p - light_.center, light_.axes.w);
    reaches = reaches || !clamp || depth < deepest_;
    const Vec3 way = -light_.from_receiver(p);
    // Of a near light all that lies behind its plane is left as it is.
    if (!clamp || (!light_.distant && depth <= 0x1p-20 * deepest_))
      stretch(box, way);
    else if (depth < deepest_)
      box.add(box_around({p + way * (light_.distant ? deepest_ - depth : deepest_ / depth - 1.0)}));
  }
  return reaches;
}

void VolumeCounter::add_item(Box box, std::uint32_t polygon) {
  Item item{{}, box, polygon};
  for (std::size_t k = 0; k < 3; ++k) {
    item.box.low[k] -= margin_;
    item.box.high[k] += margin_;
    const double low = std::max(item.box.low[k], reach_.low[k]);
    double high = item.box.high[k];
    if (k < 2) high = std::min(high, reach_.high[k]);
    if (low > high) return;  // beside the receivers, or behind all of them on their lines
    item.at[k] = 0.5 * low + 0.5 * std::min(high, std::numeric_limits<double>::max());
  }
  items_.push_back(item);
  ++(polygon < polygons_.caps.size() ? caps_ : sides_);
}

VolumeCounter::VolumeCounter(const VolumePolygons& polygons, const AreaLight& light,
                             const Receivers& receivers, const CounterOptions& options)
    : light_(light), polygons_(polygons), reach_(box_around({})) {
  along_ = glm::normalize(-light.axes.w + kAskewU * light.axes.u + kAskewV * light.axes.v);
  u_ = glm::normalize(glm::cross(light.axes.v, along_));
  v_ = glm::cross(along_, u_);
  deepest_ = -kInfinity;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Vec3& x = receivers.points[i];
    if (!receivers.is_present(i) || light.is_behind(x)) continue;
    reach_.add(box_around({x}));
    deepest_ = std::max(deepest_, glm::dot(light.distant ? x : x - light.center, light.axes.w));
  }
  if (!(reach_.low[0] <= reach_.high[0])) return;
  for (std::size_t k = 0; k < 3; ++k)
    margin_ = std::max({margin_, std::abs(reach_.low[k]), std::abs(reach_.high[k])});
  margin_ *= kRounding;
  deepest_ += margin_ + std::abs(deepest_) * kRounding;

  for (std::uint32_t i = 0; i < polygons.caps.size(); ++i) {
    const FaceCorners& t = polygons.caps[i].corners;
    add_item(box_around({t.a, t.b, t.c}), i);
    // The center is in front of every cap: a line from there meets those whose normals it runs against.
    if (!light.distant) at_infinity_ += passes(t, light.center, along_) < 0;
  }
  for (std::uint32_t i = 0; i < polygons.sides.size(); ++i) {
    const VolumeSide& side = polygons.sides[i];
    Box box = box_around({side.a, side.b});
    if (clamp_side(side, options.clamp, box))
      add_item(box, static_cast<std::uint32_t>(polygons.caps.size()) + i);
  }
  build();
}

void VolumeCounter::build() {
  if (items_.empty()) return;
  order_by_place(items_.data(), items_.data() + items_.size(), kLeaf);
  std::vector<Box> level;
  for (std::size_t first = 0; first < items_.size(); first += kLeaf) {
    Box box = items_[first].box;
    for (std::size_t i = first; i < std::min(first + kLeaf, items_.size()); ++i) box.add(items_[i].box);
    level.push_back(box);
  }
  levels_.push_back(std::move(level));
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above;
    for (std::size_t i = 0; i < below.size(); i += 2) {
      above.push_back(below[i]);
      if (i + 1 < below.size()) above.back().add(below[i + 1]);
    }
    levels_.push_back(std::move(above));
  }
}

/// Volumes that the line leaves at a cap: 1, -1 where it enters one, else 0.
int VolumeCounter::crossing(const VolumeCap& cap, const RayStart& start) const {
  const int way = passes(cap.corners, start.point, along_);
  if (way == 0) return 0;
  const bool own =
      start.object >= 0 && static_cast<std::uint32_t>(start.object) == cap.object && start.face == cap.face;
  const bool is_inside = !own && side_of_plane(cap.corners, start.point) < 0;
  if (way > 0) return is_inside ? 1 : 0;
  return is_inside ? 0 : -1;
}

int VolumeCounter::crossing(const VolumeSide& side, const Vec3& x) const {
  const Vec3 a = side.a - x, b = side.b - x, c = light_.from_receiver(x);
  const double of_a = det(b, c, along_), of_b = det(c, a, along_), of_c = det(a, b, along_);
  if (is_negative(of_a) != is_negative(of_b) || is_negative(of_c) == is_negative(of_a)) return 0;
  const double sum = of_a + of_b + (light_.distant ? 0.0 : of_c);
  if (is_negative(sum) != is_negative(of_a)) return 0;          // on the other side of the center
  if (is_negative(det(a, b, c)) != is_negative(sum)) return 0;  // behind the receiver
  return is_negative(sum) ? -side.volumes : side.volumes;
}

int VolumeCounter::volumes_around(const RayStart& start, CrossingCounts& counts) const {
  int volumes = at_infinity_;
  if (levels_.empty()) return volumes;
  const Vec3 p = across(start.point);
  const auto misses = [&](const Box& box) {
    return p.x < box.low[0] || p.x > box.high[0] || p.y < box.low[1] || p.y > box.high[1] ||
           p.z > box.high[2];
  };
  struct Node {
    std::size_t level, place;
  };
  // Depth first, two children a node: at most one entry a level waits, and one more.
  std::array<Node, 128> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {levels_.size() - 1, 0};
  while (waiting > 0) {
    const Node node = stack[--waiting];
    if (misses(levels_[node.level][node.place])) continue;
    if (node.level > 0) {
      const std::size_t first = 2 * node.place;
      if (first + 1 < levels_[node.level - 1].size()) stack[waiting++] = {node.level - 1, first + 1};
      stack[waiting++] = {node.level - 1, first};
      continue;
    }
    for (std::size_t i = node.place * kLeaf; i < std::min((node.place + 1) * kLeaf, items_.size()); ++i) {
      const Item& item = items_[i];
      if (misses(item.box)) continue;
      ++counts.tested;
      const std::size_t caps = polygons_.caps.size();
      const int step = item.polygon < caps ? crossing(polygons_.caps[item.polygon], start)
                                           : crossing(polygons_.sides[item.polygon - caps], start.point);
      counts.crossed += step != 0;
      volumes += step;
    }
  }
  return volumes;
}

}  // namespace penumbra::detail
