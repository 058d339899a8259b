#include "render/silhouette_integrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

using glm::dvec2;

double cross(const dvec2& p, const dvec2& q) {
  return p.x * q.y - p.y * q.x;
}

/// An end of a segment on its way through the cuts.
struct End {
  dvec2 at;
  bool moved = false;  ///< now on D's boundary
  bool on_chord = false;
};

/// Cuts a → b to the disk. False where nothing is left.
bool cut_to_disk(End& a, End& b) {
  const bool in_a = glm::dot(a.at, a.at) < 1.0, in_b = glm::dot(b.at, b.at) < 1.0;
  if (in_a && in_b) return true;
  const dvec2 way = b.at - a.at;
  const double length = glm::length(way);
  if (!(length > 0.0)) return false;
  const dvec2 d = way / length;
  // Foot of the centre's perpendicular, from the end that is less far away.
  const bool a_nearer = glm::dot(a.at, a.at) <= glm::dot(b.at, b.at);
  const double distance = cross(a_nearer ? a.at : b.at, d);
  const double half = std::sqrt(std::max(0.0, (1.0 - distance) * (1.0 + distance)));
  const dvec2 foot = distance * dvec2(d.y, -d.x);
  if (!in_a && !in_b) {
    if (!(std::abs(distance) < 1.0) || !(glm::dot(a.at, d) < 0.0) || !(glm::dot(b.at, d) > 0.0)) return false;
  }
  if (!in_a) a = {foot - half * d, true, false};
  if (!in_b) b = {foot + half * d, true, false};
  return true;
}

/// Cuts what is left to the horizon's side. False where nothing is left.
bool cut_to_horizon(End& a, End& b, const Chord& horizon) {
  const double ha = height(horizon, a.at), hb = height(horizon, b.at);
  if (ha > 0.0 && hb > 0.0) return true;
  if (!(ha > 0.0) && !(hb > 0.0)) return false;
  const dvec2 at = a.at + (ha / (ha - hb)) * (b.at - a.at);
  (ha > 0.0 ? b : a) = {at, true, true};
  return true;
}

/// Σ jump · a × b, in four sums that do not wait for each other.
double sum_of_crosses(std::span<const Segment> segments) {
  std::array<double, 4> sums{};
  const std::size_t whole = segments.size() / sums.size() * sums.size();
  for (std::size_t i = 0; i < whole; i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const Segment& s = segments[i + k];
      sums[k] += s.jump * cross(s.a, s.b);
    }
  for (const Segment& s : segments.subspan(whole)) sums[0] += s.jump * cross(s.a, s.b);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

void cut_segments(std::span<const Segment> segments, std::size_t inside, const DiskPart& part, Cut& out) {
  out.segments.assign(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(inside));
  out.events.clear();
  double sum = 0.0;
  int changes = 0;
  const auto cross_boundary = [&](const End& end, int change) {
    if (!end.moved) return;
    Event& event = out.events.emplace_back();  // in place: a copy would wait for what is being written
    event.at.x = end.at.x;
    event.at.y = end.at.y;
    event.on_chord = end.on_chord;
    event.change = change;
    changes += change;
  };
  sum += 0.5 * sum_of_crosses(out.segments);
  for (const Segment& s : segments.subspan(inside)) {
    End a{s.a}, b{s.b};
    if (!cut_to_disk(a, b)) continue;
    if (part.is_cut() && !cut_to_horizon(a, b, part.horizon())) continue;
    cross_boundary(a, -s.jump);
    cross_boundary(b, s.jump);
    sum += 0.5 * s.jump * cross(a.at, b.at);
    Segment& left = out.segments.emplace_back();  // in place, too
    left.a.x = a.at.x;
    left.a.y = a.at.y;
    left.b.x = b.at.x;
    left.b.y = b.at.y;
    left.jump = s.jump;
  }
  out.integral = sum - part.sum_walked(out.events);
  out.closed = changes == 0;
}

bool is_one_chain(const Cut& cut) {
  if (cut.events.size() != 2) return false;
  dvec2 general(0.0);
  const int size = std::abs(cut.segments.empty() ? 0 : cut.segments.front().jump);
  for (const Segment& s : cut.segments) {
    if (std::abs(s.jump) != size) return false;
    general += s.jump > 0 ? s.b - s.a : s.a - s.b;
  }
  return std::all_of(cut.segments.begin(), cut.segments.end(),
                     [&](const Segment& s) { return glm::dot(s.b - s.a, general) * s.jump >= 0.0; });
}

}  // namespace penumbra::detail
