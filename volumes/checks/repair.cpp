#include "penumbra/volumes/checks/repair.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "mesh/topology/cavities.h"
#include "volumes/checks/surface_queries.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {

namespace {

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

EdgeKey undirected(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

IndexedTriangle turned_round(const IndexedTriangle& t) {
  return {t[0], t[2], t[1]};
}

class Repairer {
 public:
  Repairer(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
           const RepairOptions& options)
      : options_(options),
        mesh_(TriangleMesh::build(positions, triangles, {.weld = true, .flip_inside_out = false})) {
    weld(positions, triangles);
  }

  RepairResult run() {
    result_.degenerate = mesh_.report().degenerate;
    result_.welded_vertices = mesh_.report().welded_vertices;
    const std::span<const Component> components = mesh_.components();
    const std::vector<bool> is_cavity =
        detail::find_cavities(components, mesh_.positions(), mesh_.triangles());
    std::vector<std::uint32_t> rest;
    for (std::size_t i = 0; i < components.size(); ++i) {
      std::vector<std::uint32_t> faces = sources_of(components[i]);
      if (!components[i].closed)
        rest.insert(rest.end(), faces.begin(), faces.end());
      else if (!drop_if_repeated(faces))
        settle_closed(std::move(faces), components[i].signed_volume < 0.0 && !is_cavity[i]);
    }
    std::sort(rest.begin(), rest.end());
    for (std::vector<std::uint32_t>& group : collected(rest))
      if (!drop_if_repeated(group)) result_.components.push_back(settle_open(std::move(group)));
    for (ComponentRepair& repair : result_.components) {
      std::sort(repair.faces.begin(), repair.faces.end());
      std::sort(repair.dropped.begin(), repair.dropped.end());
    }
    std::sort(result_.components.begin(), result_.components.end(),
              [](const auto& a, const auto& b) { return a.faces.front() < b.faces.front(); });
    emit();
    return std::move(result_);
  }

 private:
  std::uint32_t source(FaceId f) const { return mesh_.source_triangles()[index(f)]; }

  std::vector<std::uint32_t> sources_of(const Component& component) const {
    std::vector<std::uint32_t> faces;
    for (const FaceId f : component.faces) faces.push_back(source(f));
    return faces;
  }

  IndexedTriangle sorted_corners(std::uint32_t f) const {
    IndexedTriangle t = input_[f];
    std::sort(t.begin(), t.end());
    return t;
  }

  /// The input over welded positions. The built mesh cannot serve: it has copies of vertices along cuts.
  void weld(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles) {
    const auto less = [](const Vec3& a, const Vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<Vec3, std::uint32_t, decltype(less)> numbers(less);
    for (const IndexedTriangle& t : triangles) {
      IndexedTriangle w;
      for (int k = 0; k < 3; ++k) {
        const auto [at, is_new] =
            numbers.try_emplace(positions[t[k]], static_cast<std::uint32_t>(result_.positions.size()));
        if (is_new) result_.positions.push_back(positions[t[k]]);
        w[k] = at->second;
      }
      input_.push_back(w);
    }
  }

  /// Faces joined over shared edges, each group ascending.
  std::vector<std::vector<std::uint32_t>> collected(const std::vector<std::uint32_t>& faces) const {
    std::vector<std::uint32_t> parent(faces.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    std::map<EdgeKey, std::uint32_t> first;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      const IndexedTriangle& t = input_[faces[i]];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t other = first.try_emplace(undirected(t[k], t[(k + 1) % 3]), i).first->second;
        parent[root(i)] = root(other);
      }
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
    for (std::uint32_t i = 0; i < faces.size(); ++i) groups[root(i)].push_back(faces[i]);
    std::vector<std::vector<std::uint32_t>> result;
    result.reserve(groups.size());
    for (auto& [r, group] : groups) result.push_back(std::move(group));
    return result;
  }

  std::vector<IndexedTriangle> triangles_of(const std::vector<std::uint32_t>& faces) const {
    std::vector<IndexedTriangle> result;
    result.reserve(faces.size());
    for (const std::uint32_t f : faces) result.push_back(input_[f]);
    return result;
  }

  void count_intersections(const std::vector<std::uint32_t>& faces, ComponentRepair& repair) const {
    std::vector<IndexedTriangle> with_area;
    for (const IndexedTriangle& t : triangles_of(faces)) {
      if (!detail::collinear(result_.positions[t[0]], result_.positions[t[1]], result_.positions[t[2]]))
        with_area.push_back(t);
    }
    const auto [positions, triangles] = compact(with_area);
    repair.self_intersections =
        detail::self_intersections(positions, triangles, options_.most_intersections + 1).size();
    repair.all_counted = repair.self_intersections <= options_.most_intersections;
    repair.self_intersections = std::min(repair.self_intersections, options_.most_intersections);
  }

  std::pair<std::vector<Vec3>, std::vector<IndexedTriangle>> compact(
      std::vector<IndexedTriangle> triangles) const {
    std::map<std::uint32_t, std::uint32_t> own;
    std::vector<Vec3> positions;
    for (IndexedTriangle& t : triangles) {
      for (std::uint32_t& v : t) {
        const auto [at, is_new] = own.try_emplace(v, static_cast<std::uint32_t>(positions.size()));
        if (is_new) positions.push_back(result_.positions[v]);
        v = at->second;
      }
    }
    return {std::move(positions), std::move(triangles)};
  }

  void settle_closed(std::vector<std::uint32_t> faces, bool is_inside_out) {
    ComponentRepair repair;
    repair.faces = std::move(faces);
    count_intersections(repair.faces, repair);
    if (repair.self_intersections > 0) {
      repair.verdict = RepairVerdict::kLeft;
    } else {
      if (is_inside_out) {
        repair.verdict = RepairVerdict::kMended;
        repair.flipped = repair.faces;
      }
      for (const std::uint32_t f : repair.faces)
        closed_at_.try_emplace(sorted_corners(f), result_.components.size());
    }
    result_.components.push_back(std::move(repair));
  }

  /// Drops the faces where each repeats one of a closed component that is not left as it is; they count as
  /// that component's.
  bool drop_if_repeated(const std::vector<std::uint32_t>& faces) {
    const auto repeats = [&](std::uint32_t f) { return closed_at_.contains(sorted_corners(f)); };
    if (!std::all_of(faces.begin(), faces.end(), repeats)) return false;
    for (const std::uint32_t f : faces) {
      ComponentRepair& repair = result_.components[closed_at_.at(sorted_corners(f))];
      repair.verdict = RepairVerdict::kMended;
      repair.faces.push_back(f);
      repair.dropped.push_back(f);
    }
    return true;
  }

  ComponentRepair settle_open(std::vector<std::uint32_t> faces) const {
    ComponentRepair repair;
    repair.verdict = RepairVerdict::kLeft;
    repair.faces = std::move(faces);
    std::vector<std::uint32_t> kept;
    drop_repeated(repair, kept);
    count_edges(kept, repair);
    count_intersections(kept, repair);
    if (repair.boundary_edges + repair.non_manifold_edges + repair.self_intersections == 0 &&
        turn_alike(kept, repair)) {
      repair.verdict = RepairVerdict::kMended;
      repair.stitched_edges = cut_edges(kept);
    } else {
      repair.dropped.clear();
    }
    return repair;
  }

  void drop_repeated(ComponentRepair& repair, std::vector<std::uint32_t>& kept) const {
    std::set<IndexedTriangle> seen;
    for (const std::uint32_t f : repair.faces)
      (seen.insert(sorted_corners(f)).second ? kept : repair.dropped).push_back(f);
  }

  void count_edges(const std::vector<std::uint32_t>& kept, ComponentRepair& repair) const {
    std::map<EdgeKey, int> faces_at;
    for (const std::uint32_t f : kept) {
      for (int k = 0; k < 3; ++k) ++faces_at[undirected(input_[f][k], input_[f][(k + 1) % 3])];
    }
    for (const auto& [edge, count] : faces_at) {
      repair.boundary_edges += count == 1;
      repair.non_manifold_edges += count > 2;
    }
  }

  /// False where faces cannot be turned alike.
  bool turn_alike(const std::vector<std::uint32_t>& kept, ComponentRepair& repair) const {
    const auto [positions, triangles] = compact(triangles_of(kept));
    auto turned = detail::oriented_alike(positions, triangles);
    repair.not_orientable = !turned;
    if (!turned) return false;
    const TriangleMesh mesh =
        TriangleMesh::build(positions, *turned, {.weld = false, .flip_inside_out = false});
    double volume = 0.0;
    for (const Component& component : mesh.components()) volume += component.signed_volume;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (is_even(triangles[i], (*turned)[i]) == (volume < 0.0)) repair.flipped.push_back(kept[i]);
    }
    return true;
  }

  /// Whether two triangles of the same corners run the same way.
  static bool is_even(const IndexedTriangle& a, const IndexedTriangle& b) {
    const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return b[(at + 1) % 3] == a[1];
  }

  /// Edges of these faces that are boundaries in the built mesh, counted once.
  std::size_t cut_edges(const std::vector<std::uint32_t>& faces) const {
    const std::set<std::uint32_t> among(faces.begin(), faces.end());
    std::set<EdgeKey> cut;
    for (const Edge& e : mesh_.edges()) {
      if (!e.is_boundary() || !among.count(source(e.left))) continue;
      const IndexedTriangle& built = mesh_.triangles()[index(e.left)];
      const IndexedTriangle& welded = input_[source(e.left)];
      const auto corner = [&](VertexId v) {
        return welded[std::find(built.begin(), built.end(), static_cast<std::uint32_t>(v)) - built.begin()];
      };
      cut.insert(undirected(corner(e.from), corner(e.to)));
    }
    return cut.size();
  }

  void emit() {
    std::vector<std::uint8_t> out(input_.size(), 0), flip(input_.size(), 0);
    for (const std::uint32_t f : result_.degenerate) out[f] = 1;
    for (const ComponentRepair& repair : result_.components) {
      for (const std::uint32_t f : repair.dropped) out[f] = 1;
      for (const std::uint32_t f : repair.flipped) flip[f] = 1;
    }
    for (std::uint32_t f = 0; f < input_.size(); ++f) {
      if (out[f]) continue;
      result_.triangles.push_back(flip[f] ? turned_round(input_[f]) : input_[f]);
      result_.source_triangles.push_back(f);
    }
  }

  RepairOptions options_;
  TriangleMesh mesh_;
  std::vector<IndexedTriangle> input_;  ///< over welded positions
  /// For the sorted corners of each face of a closed component that is not left: its number in the result.
  std::map<IndexedTriangle, std::size_t> closed_at_;
  RepairResult result_;
};

}  // namespace

RepairResult repair(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                    const RepairOptions& options) {
  return Repairer(positions, triangles, options).run();
}

}  // namespace penumbra
