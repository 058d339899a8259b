#include "volumes/cells/inverted_folds.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "penumbra/volumes/predicates/predicates.h"
#include "volumes/cells/triangle_contact.h"

namespace penumbra::detail {

namespace {

// Speed: regions beyond this number, the smallest ones, count as folds without a look.
constexpr std::size_t kMostRegions = 64;
// Faces of a region that are tried, and lines from each.
constexpr std::size_t kTriedFaces = 16;
constexpr int kTriedLines = 6;

class FoldFinder {
 public:
  FoldFinder(const TriangleMesh& mesh, const Component& component, const FaceTree& tree)
      : mesh_(mesh), component_(component), tree_(tree), meets_(component.faces.size()) {}

  std::vector<FaceId> run() {
    find_contacts();
    std::vector<FaceId> folds;
    for (const FaceId f : component_.faces)
      if (meets_[place(f)]) folds.push_back(f);
    if (folds.empty()) return folds;
    std::vector<std::vector<FaceId>> regions = regions_without_contact();
    std::stable_sort(regions.begin(), regions.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    for (std::size_t i = 0; i < regions.size(); ++i)
      if (i >= kMostRegions || is_negative_in_front(regions[i]))
        folds.insert(folds.end(), regions[i].begin(), regions[i].end());
    std::sort(folds.begin(), folds.end());
    return folds;
  }

 private:
  /// Of a face of the component among its faces, which are ascending.
  std::size_t place(FaceId f) const {
    return static_cast<std::size_t>(std::lower_bound(component_.faces.begin(), component_.faces.end(), f) -
                                    component_.faces.begin());
  }
  Corners corners(FaceId f) const {
    const IndexedTriangle& t = mesh_.triangles()[index(f)];
    return {mesh_.positions()[t[0]], mesh_.positions()[t[1]], mesh_.positions()[t[2]]};
  }

  void find_contacts() {
    tree_.for_each_near_pair([&](FaceId f, FaceId g) {
      if (!do_meet_at(f, g)) return;
      meets_[place(f)].store(1, std::memory_order_relaxed);
      meets_[place(g)].store(1, std::memory_order_relaxed);
    });
  }

  /// Faces that share a side without being neighbors meet along it.
  bool do_meet_at(FaceId f, FaceId g) const {
    const IndexedTriangle &t = mesh_.triangles()[index(f)], &u = mesh_.triangles()[index(g)];
    const auto shared = std::count_if(t.begin(), t.end(), [&](std::uint32_t v) { return is_corner(v, u); });
    if (shared >= 2 && !are_neighbors(f, g)) return true;
    if (is_surely_on_one_side(g, f) || is_surely_on_one_side(f, g)) return false;
    const Corners a = corners(f), b = corners(g);
    const auto equal =
        std::count_if(a.begin(), a.end(), [&](const Vec3& p) { return p == b[0] || p == b[1] || p == b[2]; });
    return equal > std::max<std::ptrdiff_t>(1, shared) || do_meet(a, b);
  }
  static bool is_corner(std::uint32_t v, const IndexedTriangle& t) {
    return v == t[0] || v == t[1] || v == t[2];
  }

  /// Whether the corners of a face that it does not share with a plane's face are strictly on one side of the
  /// plane, in plain double. With the plane's sides e1 and e2, S = |e1||e2| and the way w from its corner,
  /// the height (e1 × e2)·w is off by less than 9 u √3 S |w| (quick_class.h), u = 2^-53. What underflow adds
  /// is far below the least height that is trusted.
  bool is_surely_on_one_side(FaceId face, FaceId of_plane) const {
    constexpr double kBound2 = 0x1p-98, kLeast2 = 1e-200;
    const IndexedTriangle &t = mesh_.triangles()[index(of_plane)], &other = mesh_.triangles()[index(face)];
    const Vec3* p = mesh_.positions().data();
    const Vec3 &a = p[t[0]], e1 = p[t[1]] - a, e2 = p[t[2]] - a, normal = glm::cross(e1, e2);
    const double s2 = glm::dot(e1, e1) * glm::dot(e2, e2);
    int sum = 0, count = 0;
    for (const std::uint32_t v : other) {
      if (is_corner(v, t)) continue;
      const Vec3 w = p[v] - a;
      const double height = glm::dot(normal, w), least2 = std::max(kLeast2, kBound2 * s2 * glm::dot(w, w));
      if (!(height * height > least2)) return false;
      sum += height > 0.0 ? 1 : -1;
      ++count;
    }
    return count > 0 && std::abs(sum) == count;
  }

  bool are_neighbors(FaceId f, FaceId g) const {
    const auto& edges = mesh_.face_edges()[index(f)];
    return std::any_of(edges.begin(), edges.end(), [&](EdgeId e) { return across(e, f) == g; });
  }
  FaceId across(EdgeId e, FaceId f) const {
    const Edge& edge = mesh_.edges()[index(e)];
    return edge.left == f ? edge.right : edge.left;
  }

  std::vector<std::vector<FaceId>> regions_without_contact() const {
    std::vector<char> seen(component_.faces.size(), 0);
    std::vector<std::vector<FaceId>> regions;
    for (const FaceId seed : component_.faces) {
      if (meets_[place(seed)] || seen[place(seed)]) continue;
      std::vector<FaceId>& region = regions.emplace_back();
      region.push_back(seed);
      seen[place(seed)] = 1;
      for (std::size_t i = 0; i < region.size(); ++i)
        for (const EdgeId e : mesh_.face_edges()[index(region[i])]) {
          const FaceId next = across(e, region[i]);
          if (meets_[place(next)] || seen[place(next)]) continue;
          seen[place(next)] = 1;
          region.push_back(next);
        }
    }
    return regions;
  }

  /// True where no face of the region can tell.
  bool is_negative_in_front(const std::vector<FaceId>& region) const {
    const std::size_t step = std::max<std::size_t>(1, region.size() / kTriedFaces);
    for (std::size_t i = 0; i < region.size(); i += step)
      if (const std::optional<int> winding = winding_in_front_of(region[i])) return *winding < 0;
    return true;
  }

  /// The winding number at a point in front of the face, if nothing but the face is between the point and one
  /// behind it.
  std::optional<int> winding_in_front_of(FaceId f) const {
    const Corners t = corners(f);
    const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]), middle = (t[0] + t[1] + t[2]) / 3.0;
    const double length = glm::length(normal), size = std::sqrt(length);
    if (!(length > 0.0)) return std::nullopt;
    for (const double away : {1e-3, 1e-6, 1e-9}) {
      const Vec3 front = middle + (away * size / length) * normal,
                 back = middle - (away * size / length) * normal;
      if (crossings(back, front) != 1 || crossing(back, front, t) != 1) continue;
      for (int line = 0; line < kTriedLines; ++line)
        if (const std::optional<int> out = crossings(front, outside(front, line))) return *out;
    }
    return std::nullopt;
  }

  /// Beyond the component along an axis, a little askew.
  Vec3 outside(const Vec3& from, int line) const {
    const Bounds& box = mesh_.bounds();
    const double far = 2.0 * (box.radius() + glm::length(from - box.center())),
                 askew = 1e-3 * far * (1 + line);
    Vec3 end = from;
    const int axis = line % 3;
    end[axis] += line < 3 ? far : -far;
    end[(axis + 1) % 3] += 0.37 * askew;
    end[(axis + 2) % 3] -= 0.29 * askew;
    return end;
  }

  /// How often a segment leaves the surface more than it enters; nothing where it touches an edge.
  std::optional<int> crossings(const Vec3& x, const Vec3& y) const {
    Bounds box;
    box.add(x);
    box.add(y);
    int sum = 0;
    const bool clean = tree_.for_each_near(box, [&](FaceId f) {
      const std::optional<int> c = crossing(x, y, corners(f));
      sum += c.value_or(0);
      return c.has_value();
    });
    return clean ? std::optional(sum) : std::nullopt;
  }

  const TriangleMesh& mesh_;
  const Component& component_;
  const FaceTree& tree_;
  std::vector<std::atomic<char>> meets_;  ///< per face of the component: it meets another
};

}  // namespace

std::vector<FaceId> faces_of_inverted_folds(const TriangleMesh& mesh, const Component& component,
                                            const FaceTree& tree) {
  return FoldFinder(mesh, component, tree).run();
}

}  // namespace penumbra::detail
