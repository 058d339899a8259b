#include "render/plan/penumbra_width.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace penumbra::detail {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

class Widths {
 public:
  Widths(const Scene& objects, const CircularLight& light, const LightSides& sides,
         const Receivers& receivers, std::span<const CasterFacts> casters)
      : light_(light), normal_(light_frame(light).w), sides_(sides), receivers_(receivers) {
    for (const CasterFacts& caster : casters)
      if (caster.reach == CasterReach::kMayReach)
        casters_.push_back(objects.objects[caster.object].mesh.bounds());
  }

  /// Of the receivers of a group, in distances between them.
  double of_group(const ReceiverBoxes& boxes, std::size_t leaf) const {
    const ReceiverBox& box = boxes.leaf(leaf);
    if (box.count == 0 || sides_.is_dark(box, true)) return 0.0;
    const double width = parallel_to_light(box.points);
    double widest = 0.0;
    boxes.for_each_in_leaf(leaf, [&](std::uint32_t i) {
      if (receivers_.is_present(i)) widest = std::max(widest, width * inclination(i) / spacing(i));
    });
    return widest;
  }

 private:
  double depth(const Vec3& p) const { return glm::dot(normal_, light_.is_distant() ? p : p - light_.center); }
  /// The least and the largest depth of a box.
  std::pair<double, double> depths(const Bounds& box) const {
    const double middle = depth(box.center());
    const Vec3 half = 0.5 * (box.high - box.low), n = glm::abs(normal_);
    return {middle - glm::dot(n, half), middle + glm::dot(n, half)};
  }

  double parallel_to_light(const Bounds& points) const {
    const double far = depths(points).second;
    double width = 0.0;
    for (const Bounds& caster : casters_) {
      if (sides_.separates(points, caster)) continue;
      const double near = depths(caster).first, gap = std::max(0.0, far - near);
      if (light_.is_distant())
        width = std::max(width, 2.0 * light_.radius * gap);
      else
        width = near > 0.0 ? std::max(width, 2.0 * light_.radius * gap / near) : kEndless;
    }
    return width;
  }

  /// 1 / cos of the angle between a receiver's normal and its way to the light; 0 where it sees none of the
  /// light.
  double inclination(std::uint32_t i) const {
    const Vec3 way = way_to_center(light_, receivers_.points[i]), n = receivers_.normals[i];
    const double height = glm::dot(n, way), fall = light_.radius * glm::length(glm::cross(n, normal_));
    if (height <= -fall) return 0.0;
    return height > fall ? glm::length(way) / height : kEndless;
  }

  /// To the nearer of the next pixels on the same object.
  double spacing(std::uint32_t i) const {
    const auto width = static_cast<std::uint32_t>(receivers_.width);
    double least = kEndless;
    const auto look_at = [&](bool inside, std::uint32_t k) {
      if (inside && receivers_.objects[k] == receivers_.objects[i])
        least = std::min(least, glm::length(receivers_.points[k] - receivers_.points[i]));
    };
    look_at((i + 1) % width != 0, i + 1);
    look_at(i % width != 0, i - 1);
    look_at(i + width < receivers_.size(), i + width);
    look_at(i >= width, i - width);
    return least < kEndless ? least : 0.0;  // alone: nothing tells
  }

  const CircularLight light_;
  const Vec3 normal_;
  const LightSides& sides_;
  const Receivers& receivers_;
  std::vector<Bounds> casters_;
};

}  // namespace

double widest_penumbra(const Scene& objects, const CircularLight& light, const LightSides& sides,
                       const Receivers& receivers, const ReceiverBoxes& boxes,
                       std::span<const CasterFacts> casters) {
  if (!receivers.are_pixels() || !receivers.has_normals() || receivers.objects.empty()) return kEndless;
  const Widths widths(objects, light, sides, receivers, casters);
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, boxes.leaves()), 0.0,
      [&](const auto& range, double widest) {
        for (std::size_t leaf = range.begin(); leaf < range.end(); ++leaf) {
          const double width = widths.of_group(boxes, leaf);
          widest = std::isnan(width) ? kEndless : std::max(widest, width);
        }
        return widest;
      },
      [](double a, double b) { return std::max(a, b); });
}

}  // namespace penumbra::detail
