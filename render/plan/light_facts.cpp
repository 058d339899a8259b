#include "render/plan/light_facts.h"

#include <tbb/parallel_for.h>

#include "render/plan/light_sides.h"
#include "render/plan/penumbra_width.h"
#include "render/plan/sampled_facts.h"

namespace penumbra::detail {
namespace {

/// The light, or the smallest disk around it.
CircularLight circle_around(const LightShape& light) {
  if (const auto* distant = std::get_if<DistantLight>(&light)) return *distant;
  return disk_around(light);
}

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

  CasterReach of_caster(const Bounds& box) const {
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

  bool is_dark(std::uint32_t index) const {
    ReceiverBox one;
    one.points.add(receivers_.points[index]);
    if (receivers_.has_normals()) one.normals.add(receivers_.normals[index]);
    one.count = 1;
    return sides_.is_dark(one, horizon_);
  }

 private:
  const LightSides sides_;
  const Receivers& receivers_;
  const ReceiverBoxes& boxes_;
  const bool horizon_;
};

}  // namespace

LightFacts measure_light(const Scene& objects, const RayScene& rays, const LightShape& light,
                         const Receivers& receivers, const ReceiverBoxes& boxes, const PlanRequest& request) {
  const CircularLight circle = circle_around(light);
  // O has no horizon.
  const Reach reach(circle, receivers, boxes, !request.with_unoccluded);
  LightFacts facts{.is_point = is_point(light),
                   .is_rectangle = std::holds_alternative<RectangleLight>(light),
                   .receivers = boxes.present()};
  for (std::size_t i = 0; i < objects.objects.size(); ++i) {
    const SceneObject& object = objects.objects[i];
    if (object.casts && !object.mesh.empty())
      facts.casters.push_back({.object = i,
                               .name = object.name,
                               .faces = object.mesh.triangles().size(),
                               .edges = object.mesh.edges().size()});
  }
  rays.arena().execute([&] {
    facts.dark = reach.count_dark();
    tbb::parallel_for(std::size_t{0}, facts.casters.size(), [&](std::size_t k) {
      facts.casters[k].reach = reach.of_caster(objects.objects[facts.casters[k].object].mesh.bounds());
    });
  });
  if (request.hard_below > 0.0)
    facts.widest_penumbra = rays.arena().execute([&] {
      return widest_penumbra(objects, circle, LightSides(circle), receivers, boxes, facts.casters);
    });
  if (!facts.is_point)
    facts.sampled = sample_light(objects, rays, circle, light, receivers, facts.casters,
                                 [&](std::uint32_t index) { return reach.is_dark(index); });
  return facts;
}

}  // namespace penumbra::detail
