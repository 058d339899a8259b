#include "render/silhouette/collect/receiver_shells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/receivers/occluding_casters.h"

namespace penumbra::detail {
namespace {

// Speed. Seen in the benchmark `silhouette` with a large floor.
/// The innermost shell reaches to so many times the radius of the casters, and each one that many times
/// farther than the one before.
constexpr double kFactor = 64.0;
/// The last shell has all that lies farther out.
constexpr std::size_t kMostShells = 12;

/// The farthest corner of the box of a group from a point.
double distance_to(const Bounds& box, const Vec3& from) {
  return glm::length(glm::max(glm::abs(box.low - from), glm::abs(box.high - from)));
}

std::size_t shell_of(double distance, double radius) {
  std::size_t shell = 0;
  for (double reach = kFactor * radius; distance > reach && shell + 1 < kMostShells; reach *= kFactor)
    ++shell;
  return shell;
}

}  // namespace

std::vector<ReceiverShell> receiver_shells(const BoxedGroups& groups, const Bounds& casters) {
  std::vector<ReceiverShell> shells(kMostShells);
  for (std::uint32_t g = 0; g < groups.boxes.size(); ++g) {
    const Bounds& box = groups.boxes[g].points;
    if (box.empty()) continue;
    ReceiverShell& shell =
        shells[casters.empty() ? 0 : shell_of(distance_to(box, casters.center()), casters.radius())];
    shell.groups.push_back(g);
    shell.asked_about.add(box);
  }
  std::erase_if(shells, [](const ReceiverShell& s) { return s.groups.empty(); });
  for (ReceiverShell& shell : shells) shell.asked_about.add(casters);
  return shells;
}

ShelledReceivers::ShelledReceivers(const Scene& scene, const CircularLight& light, const Receivers& receivers,
                                   const BoxedGroups& groups_of)
    : boxed(groups_of),
      groups(groups_of.groups),
      cannot_occlude(find_casters_that_cannot_occlude(scene, light, receivers)) {
  Bounds casters;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].casts && !cannot_occlude[i]) casters.add(scene.objects[i].mesh.bounds());
  shells = receiver_shells(boxed, casters);
}

}  // namespace penumbra::detail
