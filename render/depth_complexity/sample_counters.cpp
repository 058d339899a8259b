#include "render/depth_complexity/sample_counters.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace penumbra::detail {
namespace {

/// Accuracy. Of the lowest samples so many are compared, to send the ray well beside all silhouettes.
constexpr std::size_t kCandidates = 8;

/// Arrays of one receiver's samples.
struct Lanes {
  float *a, *b;
  double *x, *y, *height;
};

/// What takes places on the light to the world and to the unit disk.
struct Axes {
  Vec3 center, u, v, normal;
  glm::dvec2 unit_u, unit_v, start;
};

PENUMBRA_VECTOR_CLONES
void place(const StratumTable& table, bool disk, std::uint32_t key, const Axes& axes, std::size_t count,
           const Lanes& out) {
  const Vec3 c = axes.center, u = axes.u, v = axes.v, n = axes.normal;
  const double ux = axes.unit_u.x, uy = axes.unit_u.y, vx = axes.unit_v.x, vy = axes.unit_v.y;
  const double px = axes.start.x, py = axes.start.y;
  for (std::size_t first = 0; first < count; first += kSampleLanes) {
    float *a = out.a + first, *b = out.b + first;
    place_samples(table, disk, key, static_cast<int>(first), a, b);
    for (int k = 0; k < kSampleLanes; ++k) {
      const double s = a[k], t = b[k];
      out.x[first + static_cast<std::size_t>(k)] = ux * s + vx * t - px;
      out.y[first + static_cast<std::size_t>(k)] = uy * s + vy * t - py;
      const double x = c.x + u.x * s + v.x * t, y = c.y + u.y * s + v.y * t, z = c.z + u.z * s + v.z * t;
      out.height[first + static_cast<std::size_t>(k)] = n.x * x + n.y * y + n.z * z;
    }
  }
}

/// A segment relative to the start, and what crossing it away from the start changes.
struct Step {
  double ax, ay, bx, by, change;
};

PENUMBRA_VECTOR_CLONES
double add_step(const Step& step, const double* __restrict x, const double* __restrict y, std::size_t count,
                double* __restrict counter) {
  const double ax = step.ax, ay = step.ay, bx = step.bx, by = step.by, change = step.change;
  // The start lies at 0: its side of a b, and that of a sample, is the sign of a × b + (b - a) × p.
  const double dx = bx - ax, dy = by - ay, start = ax * by - ay * bx;
  const bool start_left = start > 0.0;
  double changed = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool a_left = ax * y[i] - ay * x[i] > 0.0, b_left = bx * y[i] - by * x[i] > 0.0;
    const bool left = start + (dx * y[i] - dy * x[i]) > 0.0;
    const double crosses = ((a_left != b_left) & (left != start_left)) ? 1.0 : 0.0;
    counter[i] += crosses * change;
    changed += crosses;
  }
  return changed;
}

double distance2(const glm::dvec2& p, const Segment& s) {
  const glm::dvec2 way = s.b - s.a, to = p - s.a;
  const double length2 = glm::dot(way, way);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(to, way) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec2 off = to - t * way;
  return glm::dot(off, off);
}

}  // namespace

SampleCounters::SampleCounters(const AreaLight& light, const UnitLight& unit, int samples)
    : light_(light),
      table_(samples),
      u_(light.axes.u * light.half.x),
      v_(light.axes.v * light.half.y),
      a_(table_.columns.size(), 0.0f),
      b_(a_),
      x_(a_.size(), 0.0),
      y_(x_),
      counter_(x_),
      height_(x_) {
  const Vec3 across = unit.offset_on_disk({1.0, 0.0}), up = unit.offset_on_disk({0.0, 1.0});
  const double radius2 = glm::dot(across, across);
  unit_u_ = glm::dvec2(glm::dot(u_, across), glm::dot(u_, up)) / radius2;
  unit_v_ = glm::dvec2(glm::dot(v_, across), glm::dot(v_, up)) / radius2;
}

void SampleCounters::begin(const SampledReceiver& receiver) {
  receiver_ = receiver;
  const Axes axes{receiver.to_center, u_, v_, receiver.normal, unit_u_, unit_v_, receiver.start};
  place(table_, light_.disk, receiver.key, axes, x_.size(),
        {a_.data(), b_.data(), x_.data(), y_.data(), height_.data()});
  if (receiver.normal == Vec3(0.0)) std::ranges::fill(height_, 1.0);
  std::fill(height_.begin() + count(), height_.end(), 0.0);
  std::ranges::fill(counter_, 0.0);
}

std::size_t SampleCounters::toggle(const Segment& segment) {
  const glm::dvec2 a = segment.a - receiver_.start, b = segment.b - receiver_.start;
  // Away from a start on the right of a → b the faces on its left are entered, and those on its right left.
  const double change = a.x * b.y - a.y * b.x > 0.0 ? -segment.jump : segment.jump;
  return static_cast<std::size_t>(
      add_step({a.x, a.y, b.x, b.y, change}, x_.data(), y_.data(), x_.size(), counter_.data()));
}

SampleCounters::Lowest SampleCounters::lowest(std::span<const Segment> segments) const {
  Lowest out;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < counter_.size(); ++i)
    if (height_[i] > 0.0) least = std::min(least, counter_[i]);
  const auto is_lowest = [&](std::size_t i) { return height_[i] > 0.0 && counter_[i] == least; };
  for (std::size_t i = 0; i < counter_.size(); ++i) out.samples += is_lowest(i) ? 1 : 0;
  const std::size_t stride = std::max<std::size_t>(1, out.samples / kCandidates);
  double farthest = -1.0;
  for (std::size_t i = 0, nth = 0; i < counter_.size() && nth < out.samples; ++i) {
    if (!is_lowest(i) || nth++ % stride != 0) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Segment& segment : segments)
      nearest = std::min(nearest, distance2(receiver_.start + glm::dvec2(x_[i], y_[i]), segment));
    if (nearest > farthest) farthest = nearest, out.aim = i;
  }
  return out;
}

Vec3 SampleCounters::way(std::size_t sample) const {
  const double s = a_[sample], t = b_[sample];
  const Vec3& c = receiver_.to_center;
  return {c.x + u_.x * s + v_.x * t, c.y + u_.y * s + v_.y * t, c.z + u_.z * s + v_.z * t};
}

}  // namespace penumbra::detail
