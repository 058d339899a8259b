#include "render/plan/light_facts.h"

#include <tbb/parallel_invoke.h>

#include <array>
#include <bit>
#include <span>

#include "render/plan/light_sides.h"
#include "render/plan/penumbra_width.h"
#include "render/plan/sample/sampled_facts.h"
#include "render/plan/second_pilot.h"
#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

/// The light, or the smallest disk around it.
CircularLight circle_around(const LightShape& light) {
  if (const auto* distant = std::get_if<DistantLight>(&light)) return *distant;
  return disk_around(light);
}

/// A caster by the middle of its box.
struct PlacedCaster {
  std::array<double, 3> at;
  std::size_t index;
  Bounds box;
};

/// How one light lies to receivers and casters.
class Reach {
 public:
  Reach(const CircularLight& light, const Receivers& receivers, const ReceiverBoxes& boxes, bool horizon)
      : sides_(light), receivers_(receivers), boxes_(boxes), horizon_(horizon) {}

  /// By groups; but all where no receiver at all is lit.
  std::size_t count_dark() const {
    const auto passes = [&](const ReceiverBox& box) { return sides_.is_dark(box, horizon_); };
    const bool any = boxes_.find(receivers_, passes, [&](std::uint32_t index) { return !is_dark(index); });
    if (!any) return boxes_.present();
    // Never all of them: then a group passes whose receivers are not all dark, by another rounding.
    return std::min(boxes_.count_passing(passes), boxes_.present() - 1);
  }

  bool is_dark(std::uint32_t index) const {
    ReceiverBox one;
    one.points.add(receivers_.points[index]);
    if (receivers_.has_normals()) one.normals.add(receivers_.normals[index]);
    one.count = 1;
    return sides_.is_dark(one, horizon_);
  }

  /// Of casters that lie close together: of all at once where that is enough. In the order of order_by_place.
  void of_casters(std::span<const PlacedCaster> some, std::vector<CasterFacts>& casters) const {
    if (some.empty()) return;
    Bounds box;
    for (const PlacedCaster& each : some) box.add(each.box);
    const CasterReach reach = of_box(box);
    if (reach != CasterReach::kMayReach || some.size() == 1) {
      for (const PlacedCaster& each : some) casters[each.index].reach = reach;
      return;
    }
    constexpr std::size_t kOneTask = 16;
    const std::size_t middle = std::bit_floor(some.size() - 1);
    const auto first = [&] { of_casters(some.first(middle), casters); };
    const auto rest = [&] { of_casters(some.subspan(middle), casters); };
    if (some.size() > kOneTask)
      tbb::parallel_invoke(first, rest);
    else
      first(), rest();
  }

 private:
  CasterReach of_box(const Bounds& box) const {
    if (sides_.is_behind(box)) return CasterReach::kBehindLight;
    const bool reaches = boxes_.find(
        receivers_,
        [&](const ReceiverBox& some) {
          return sides_.is_dark(some, horizon_) || sides_.separates(some.points, box);
        },
        [&](std::uint32_t index) {
          const Vec3& x = receivers_.points[index];
          return !is_dark(index) && !sides_.separates({x, x}, box);
        });
    return reaches ? CasterReach::kMayReach : CasterReach::kMissesReceivers;
  }

  const LightSides sides_;
  const Receivers& receivers_;
  const ReceiverBoxes& boxes_;
  const bool horizon_;
};

void find_casters(const Scene& objects, const Reach& reach, std::vector<CasterFacts>& casters) {
  std::vector<PlacedCaster> placed;
  for (std::size_t i = 0; i < objects.objects.size(); ++i) {
    const SceneObject& object = objects.objects[i];
    if (!object.casts || object.mesh.empty()) continue;
    const Bounds& box = object.mesh.bounds();
    const Vec3 middle = box.center();
    placed.push_back({{middle.x, middle.y, middle.z}, casters.size(), box});
    casters.push_back({.object = i,
                       .name = object.name,
                       .faces = object.mesh.triangles().size(),
                       .edges = object.mesh.edges().size()});
  }
  order_by_place(placed.data(), placed.data() + placed.size(), 1);
  reach.of_casters(placed, casters);
}

}  // namespace

LightFacts measure_light(const Scene& objects, const RayScene& rays, const LightShape& light,
                         const Receivers& receivers, const ReceiverBoxes& boxes, const PlanRequest& request) {
  const CircularLight circle = circle_around(light);
  // O has no horizon.
  const Reach reach(circle, receivers, boxes, !request.with_unoccluded);
  LightFacts facts{.is_point = is_point(light),
                   .is_rectangle = std::holds_alternative<RectangleLight>(light),
                   .receivers = boxes.present()};
  rays.arena().execute([&] {
    facts.dark = reach.count_dark();
    if (facts.dark < facts.receivers) find_casters(objects, reach, facts.casters);
  });
  if (facts.dark == facts.receivers) return facts;
  if (request.hard_below > 0.0)
    facts.widest_penumbra = rays.arena().execute([&] {
      return widest_penumbra(objects, circle, LightSides(circle), receivers, boxes, facts.casters);
    });
  if (!facts.is_point)
    facts.sampled = sample_light(
        objects, rays, circle, light, receivers, facts.casters,
        [&](std::uint32_t index) { return reach.is_dark(index); },
        [&](const SampledFacts& sampled) {
          facts.sampled = sampled;
          return second_pilot(facts, request);
        });
  return facts;
}

}  // namespace penumbra::detail
