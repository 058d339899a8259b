#include "render/receivers/occluding_casters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "render/receivers/separating_planes.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kPerBox = 64;

/// Receivers, and boxes of some that follow each other.
class ReceiverBoxes {
 public:
  explicit ReceiverBoxes(const Receivers& receivers)
      : receivers_(receivers), boxes_((receivers.size() + kPerBox - 1) / kPerBox) {
    tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t k) {
      for (std::size_t i = first(k); i < first(k + 1); ++i)
        if (receivers.is_present(i)) boxes_[k].add(receivers.points[i]);
    });
  }

  /// No receiver lies behind the plane of the object, as far as double can tell. Those on faces in the plane
  /// do not.
  bool are_in_front(const SeparatingPlanes::Plane& plane, std::int32_t object) const {
    const ClearHeight clear(plane);
    std::atomic<bool> behind{false};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes_.size(), 64), [&](const auto& range) {
      for (std::size_t k = range.begin(); k < range.end() && !behind; ++k) {
        if (boxes_[k].empty() || clear.is_in_front(boxes_[k])) continue;
        for (std::size_t i = first(k); i < first(k + 1); ++i)
          if (receivers_.is_present(i) && is_behind(receivers_, i, plane, object)) behind = true;
      }
    });
    return !behind;
  }

  static bool is_behind(const Receivers& receivers, std::size_t i, const SeparatingPlanes::Plane& plane,
                        std::int32_t object) {
    const bool on_face = !receivers.faces.empty() && !receivers.objects.empty() &&
                         receivers.objects[i] == object && receivers.faces[i] < plane.within.size() &&
                         plane.within[receivers.faces[i]];
    return !on_face && plane.front * side_of_plane(plane.face, receivers.points[i]) < 0;
  }

 private:
  /// A bound in plain double, far above its rounding: what is higher needs no better look.
  struct ClearHeight {
    explicit ClearHeight(const SeparatingPlanes::Plane& plane)
        : normal(double(plane.front) * glm::cross(plane.face.b - plane.face.a, plane.face.c - plane.face.a)),
          point(plane.face.a) {}
    bool is_in_front(const Bounds& box) const {
      constexpr double kFarAboveRounding = 0x1p-40;
      double height = 0.0, size = 0.0;
      for (int k = 0; k < 3; ++k) {
        const double least = normal[k] > 0.0 ? box.low[k] : box.high[k];
        height += normal[k] * (least - point[k]);
        size += std::abs(normal[k]) *
                (std::abs(point[k]) + std::max(std::abs(box.low[k]), std::abs(box.high[k])));
      }
      return height > kFarAboveRounding * size;
    }
    Vec3 normal, point;
  };

  std::size_t first(std::size_t box) const { return std::min(box * kPerBox, receivers_.size()); }

  const Receivers& receivers_;
  std::vector<Bounds> boxes_;
};

}  // namespace

std::vector<char> find_casters_that_cannot_occlude(const Scene& scene, const CircularLight& light,
                                                   const Receivers& receivers) {
  constexpr std::size_t kSome = 1009;  // a prime: spread over rows and columns
  std::vector<char> out(scene.objects.size(), 0);
  std::optional<ReceiverBoxes> boxes;  // when they are needed
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!scene.objects[k].casts) continue;
    const auto object = static_cast<std::int32_t>(k);
    const SeparatingPlanes planes(scene.objects[k].mesh);
    const auto some_are_in_front = [&](const SeparatingPlanes::Plane& plane) {
      for (std::size_t i = 0; i < receivers.size(); i += kSome)
        if (receivers.is_present(i) && ReceiverBoxes::is_behind(receivers, i, plane, object)) return false;
      return true;
    };
    if (!planes.separate(light, some_are_in_front)) continue;  // rules most casters out at little cost
    if (!boxes) boxes.emplace(receivers);
    out[k] = planes.separate(
        light, [&](const SeparatingPlanes::Plane& plane) { return boxes->are_in_front(plane, object); });
  }
  return out;
}

}  // namespace penumbra::detail
