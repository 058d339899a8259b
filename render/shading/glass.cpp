#include "render/shading/glass.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "render/light/light_integrals.h"
#include "render/shading/fill_and_fade.h"

namespace penumbra::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of what stands behind, what a surface seen edge-on hides.
constexpr double kRim = 0.4;
/// In diagonals of the casters. What is missing of a surface's rim halves with each such way before what
/// stands behind, so that a body that ends at a wall shows none there; and with each such way through the
/// body, so that what is as thin as a solid is rough shows none.
constexpr double kContact = 0.02;

/// What a sheet of albedo 1 shows at `point`, facing each light.
Vec3 brightness_at(const Scene& scene, const Vec3& point) {
  Vec3 sum = 0.75 * scene.picture.ambient;
  for (const Light& light : scene.lights) {
    const AreaLight area = area_light(light.shape);
    const Vec3 normal = glm::normalize(area.from_receiver(point));
    sum += light.radiance * irradiance_factor(area, point, normal) / std::numbers::pi;
  }
  return sum;
}

/// A disk or a rectangle that is seen.
struct SeenLight {
  AreaLight area;
  Vec3 radiance;

  /// In lengths of the direction; infinity where the ray misses it.
  double distance(const Vec3& origin, const Vec3& direction) const {
    const Vec3 o = area.to_light(origin), d = area.direction_to_light(direction);
    const double t = -o.z / d.z;
    if (!(t > 0.0)) return kInfinity;
    const double u = o.x + t * d.x, v = o.y + t * d.y;
    const bool inside = area.disk ? u * u + v * v <= area.half.x * area.half.x
                                  : std::abs(u) <= area.half.x && std::abs(v) <= area.half.y;
    return inside ? t : kInfinity;
  }
  Vec3 color_from(const Vec3& origin) const { return area.is_behind(origin) ? Vec3(0.0) : radiance; }
};

/// The way through the body on the inner side of a crossing.
double thickness_at(const std::vector<GlassCrossing>& crossings, std::size_t i) {
  const GlassCrossing& here = crossings[i];
  for (std::size_t k = i; here.enters ? ++k < crossings.size() : k-- > 0;)
    if (crossings[k].body == here.body) return std::abs(crossings[k].distance - here.distance);
  return kInfinity;
}

class Overlay {
 public:
  Overlay(const Scene& scene, const GlassRays* glass) : scene_(scene), glass_(glass) {
    // Glass is as thick as what casts is large. Where nothing casts, it is the scene; where that is empty,
    // the unit.
    const Bounds casters = scene.caster_bounds(), bounds = casters.radius() > 0.0 ? casters : scene.bounds();
    size_ = bounds.radius() > 0.0 ? 2.0 * bounds.radius() : 1.0;
    brightness_ = brightness_at(scene, bounds.radius() > 0.0 ? bounds.center() : scene.camera.target);
    if (glass_) eye_inside_ = bodies_around(scene.camera.eye);
    if (!scene.picture.show_lights) return;
    for (const Light& light : scene.lights)
      if (const AreaLight area = area_light(light.shape); !area.distant)
        lights_.push_back({area, light.radiance});
  }

  struct Pixel {
    Vec3 color;
    double alpha;
  };
  /// What the ray sees of `behind`, which is `distance` away.
  Pixel seen(const Vec3& origin, const Vec3& direction, double distance, Pixel behind,
             std::vector<GlassCrossing>& crossings) const {
    for (const SeenLight& light : lights_)
      if (const double t = light.distance(origin, direction); t < distance) {
        distance = t;
        behind = {light.color_from(origin), 1.0};
      }
    if (!glass_) return behind;
    find_crossings(origin, direction, crossings);
    return through_glass(crossings, distance, glm::length(direction) / size_, behind);
  }

 private:
  /// `unit`: the direction's length in diagonals of the casters.
  Pixel through_glass(const std::vector<GlassCrossing>& crossings, double distance, double unit,
                      const Pixel& behind) const;

  /// Of each body, how much more often a ray leaves it than enters it: whether its origin is inside.
  std::vector<int> balance_of(const std::vector<GlassCrossing>& crossings) const {
    std::vector<int> balance(scene_.glass.size(), 0);
    for (const GlassCrossing& c : crossings) balance[c.body] += c.enters ? -1 : 1;
    return balance;
  }
  std::vector<int> bodies_around(const Vec3& eye) const;
  void find_crossings(const Vec3& origin, Vec3 direction, std::vector<GlassCrossing>& crossings) const;

  const Scene& scene_;
  const GlassRays* glass_;
  std::vector<int> eye_inside_;
  double size_ = 0.0;
  Vec3 brightness_{0.0};
  std::vector<SeenLight> lights_;
};

/// What most of nine rays say.
std::vector<int> Overlay::bodies_around(const Vec3& eye) const {
  std::vector<std::vector<int>> votes(scene_.glass.size());
  std::vector<GlassCrossing> crossings;
  for (int i = 0; i < 9; ++i) {
    glass_->find_crossings(eye, Vec3(std::cos(1.3 * i), std::sin(2.1 * i) + 0.1, std::sin(1.3 * i)),
                           crossings);
    const std::vector<int> balance = balance_of(crossings);
    for (std::size_t k = 0; k < balance.size(); ++k) votes[k].push_back(balance[k]);
  }
  std::vector<int> inside;
  for (std::vector<int>& of_body : votes) {
    std::ranges::nth_element(of_body, of_body.begin() + 4);
    inside.push_back(of_body[4]);
  }
  return inside;
}

/// A ray that misses a crossing is tried again a little beside.
void Overlay::find_crossings(const Vec3& origin, Vec3 direction,
                             std::vector<GlassCrossing>& crossings) const {
  constexpr double kBeside = 1e-5;
  const double length = glm::length(direction);
  for (int i = 0; i < 4; ++i) {
    glass_->find_crossings(origin, direction, crossings);
    if (balance_of(crossings) == eye_inside_) return;
    direction += kBeside * length * Vec3(0.7, -0.4, 0.6);
  }
}

// From the front to the back.
Overlay::Pixel Overlay::through_glass(const std::vector<GlassCrossing>& crossings, double distance,
                                      double unit, const Pixel& behind) const {
  const std::vector<GlassBody>& bodies = scene_.glass;
  std::vector<int> inside = eye_inside_;
  Vec3 added(0.0);
  double through = 1.0, from = 0.0;
  const auto hide = [&](double share, const Vec3& tint) {
    added += through * share * tint * brightness_;
    through *= 1.0 - share;
  };
  // Where bodies overlap there is the glass of the last one.
  const auto go_to = [&](double to) {
    const auto holds = std::find_if(inside.rbegin(), inside.rend(), [](int times) { return times > 0; });
    if (holds != inside.rend()) {
      const GlassBody& body = bodies[static_cast<std::size_t>(inside.rend() - holds) - 1];
      hide(1.0 - std::pow(1.0 - body.density, (to - from) * unit), body.tint);
    }
    from = to;
  };
  for (std::size_t i = 0; i < crossings.size() && crossings[i].distance < distance; ++i) {
    const GlassCrossing& c = crossings[i];
    go_to(c.distance);
    const double room = std::min(distance - c.distance, thickness_at(crossings, i)) * unit;
    hide(kRim * (1.0 - std::exp2(-room / kContact)) * std::pow(1.0 - c.facing, 3.0), bodies[c.body].tint);
    inside[c.body] += c.enters ? 1 : -1;
  }
  if (distance < kInfinity) go_to(distance);
  return {added + through * behind.color, 1.0 - through * (1.0 - behind.alpha)};
}

}  // namespace

void add_glass(const Scene& scene, const GlassRays* glass, const SurfaceBuffer& surface,
               const PointInPixel& at, const Threads& threads, const ColorChannels& colors) {
  const Overlay overlay(scene, glass);
  const PixelRays pixels(scene.camera, surface.width, surface.height);
  const auto width = static_cast<std::size_t>(surface.width);
  threads->execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.size(), 1024), [&](const auto& range) {
      std::vector<GlassCrossing> crossings;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const std::size_t row = i / width, column = i % width;
        const Vec3 direction =
            pixels.direction(static_cast<double>(column) + at.x, static_cast<double>(row) + at.y);
        const double distance =
            surface.hit(i) ? glm::distance(surface.position[i], pixels.origin) / glm::length(direction)
                           : kInfinity;
        const auto [color, alpha] =
            overlay.seen(pixels.origin, direction, distance,
                         {Vec3(colors.r[i], colors.g[i], colors.b[i]), colors.a[i]}, crossings);
        colors.r[i] = static_cast<float>(color.x);
        colors.g[i] = static_cast<float>(color.y);
        colors.b[i] = static_cast<float>(color.z);
        colors.a[i] = static_cast<float>(alpha);
      }
    });
  });
}

}  // namespace penumbra::detail
