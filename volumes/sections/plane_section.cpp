#include "penumbra/volumes/sections/plane_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

/// An edge that the plane cuts, by its vertices.
using Cut = std::pair<std::uint32_t, std::uint32_t>;

/// Of one triangle.
struct Segment {
  Cut from, to;
  bool used = false;
};

class Slicer {
 public:
  Slicer(std::span<const Vec3> positions, const SectionPlane& plane)
      : positions_(positions), plane_(plane), normal_(glm::normalize(plane.normal)) {
    if (!(glm::length(plane.normal) > 0.0) || !std::isfinite(glm::length(plane.normal)))
      throw UsageError("the normal of a section's plane must be finite and not 0");
    for (const Vec3& p : positions) height_.push_back(glm::dot(normal_, p - plane.point));
  }

  Section run(std::span<const IndexedTriangle> triangles) {
    for (const IndexedTriangle& t : triangles) add(t);
    std::ranges::sort(segments_, {}, &Segment::from);
    for (const Segment& s : segments_) ends_.push_back(s.to);
    std::ranges::sort(ends_);
    // Open curves from their beginnings, then closed ones.
    for (const bool open : {true, false})
      for (Segment& s : segments_)
        if (!s.used && std::ranges::binary_search(ends_, s.from) != open) follow(s);
    return std::move(out_);
  }

 private:
  bool is_in_front(std::uint32_t v) const { return height_[v] > 0.0; }

  /// Around a triangle that is seen from outside, the section enters where the side leads behind the plane.
  void add(const IndexedTriangle& t) {
    Segment s;
    int cuts = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (is_in_front(a) == is_in_front(b)) continue;
      (is_in_front(a) ? s.from : s.to) = {std::min(a, b), std::max(a, b)};
      ++cuts;
    }
    if (cuts == 2) segments_.push_back(s);
  }

  void follow(Segment& first) {
    SectionCurve curve;
    for (Segment* s = &first; s != nullptr;) {
      s->used = true;
      append(curve, point_of(s->from));
      const Cut at = s->to;
      s = nullptr;
      if (at == first.from) break;
      const auto [begin, end] = std::ranges::equal_range(segments_, at, {}, &Segment::from);
      const auto next = std::find_if(begin, end, [](const Segment& n) { return !n.used; });
      if (next != end) {
        s = &*next;
      } else {
        curve.closed = false;
        append(curve, point_of(at));
      }
    }
    if (curve.closed && curve.points.size() > 1 && curve.points.front() == curve.points.back())
      curve.points.pop_back();
    measure(curve);
    if (curve.points.size() > (curve.closed ? 2u : 1u)) out_.curves.push_back(std::move(curve));
  }

  Vec3 point_of(const Cut& cut) const {
    const double a = height_[cut.first], b = height_[cut.second], t = a / (a - b);
    return (1.0 - t) * positions_[cut.first] + t * positions_[cut.second];
  }
  static void append(SectionCurve& curve, const Vec3& p) {
    if (curve.points.empty() || curve.points.back() != p) curve.points.push_back(p);
  }
  void measure(const SectionCurve& curve) {
    const std::vector<Vec3>& p = curve.points;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const std::size_t next = (i + 1) % p.size();
      if (next == 0 && !curve.closed) break;
      out_.length += glm::distance(p[i], p[next]);
      if (curve.closed) out_.area += 0.5 * glm::dot(normal_, glm::cross(p[i] - p[0], p[next] - p[0]));
    }
  }

  std::span<const Vec3> positions_;
  const SectionPlane& plane_;
  Vec3 normal_;
  std::vector<double> height_;
  std::vector<Segment> segments_;
  std::vector<Cut> ends_;
  Section out_;
};

}  // namespace

Section plane_section(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                      const SectionPlane& plane) {
  return Slicer(positions, plane).run(triangles);
}

}  // namespace penumbra
