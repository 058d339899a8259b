#include "volumes/cells/convex_patches.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>

#include "penumbra/volumes/predicates/predicates.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra::detail {

namespace {

// Speed: a patch has at most this many faces. More faces make fewer cells, but each try to join one costs
// more.
constexpr std::size_t kMostFaces = 64;

/// A plane through three vertices; its outer side is the one from which they run counter-clockwise.
using Plane = IndexedTriangle;

/// A face that is near the patch and not of it, with a plane that the patch is not beyond and the face not
/// behind.
struct Neighbor {
  FaceId face;
  Plane plane;
};

/// Per face its place in an order that depends on where its corners are, not on numbering.
std::vector<std::uint32_t> rank_faces(const TriangleMesh& mesh) {
  const std::span<const Vec3> p = mesh.positions();
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(p[a].x, p[a].y, p[a].z) < std::tie(p[b].x, p[b].y, p[b].z);
  };
  std::vector<std::uint32_t> order(p.size()), vertex_rank(p.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), before);
  for (std::uint32_t i = 1; i < order.size(); ++i)
    vertex_rank[order[i]] = before(order[i - 1], order[i]) ? i : vertex_rank[order[i - 1]];

  std::vector<std::pair<IndexedTriangle, std::uint32_t>> faces;
  for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
    IndexedTriangle key = mesh.triangles()[f];
    for (std::uint32_t& v : key) v = vertex_rank[v];
    std::sort(key.begin(), key.end());
    faces.emplace_back(key, f);
  }
  std::sort(faces.begin(), faces.end());
  std::vector<std::uint32_t> rank(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) rank[faces[i].second] = i;
  return rank;
}

}  // namespace

class PatchFinder::Grower {
 public:
  explicit Grower(const TriangleMesh& mesh)
      : mesh_(mesh),
        rank_(rank_faces(mesh)),
        free_(mesh.triangles().size(), false),
        patch_near_(mesh.triangles().size(), 0),
        refused_by_(mesh.triangles().size(), 0) {}

  std::vector<ConvexPatch> run(const FaceTree& component, std::span<const FaceId> members,
                               const std::function<void(const ConvexPatch&)>& after_each) {
    tree_ = &component;
    std::vector<FaceId> seeds(members.begin(), members.end());
    std::sort(seeds.begin(), seeds.end(),
              [&](FaceId f, FaceId g) { return rank_[index(f)] < rank_[index(g)]; });
    for (const FaceId f : seeds) free_[index(f)] = true;
    std::vector<ConvexPatch> patches;
    for (const FaceId f : seeds) {
      if (!free_[index(f)]) continue;
      patches.push_back(grow_from(f));
      if (after_each) after_each(patches.back());
    }
    return patches;
  }

 private:
  const IndexedTriangle& triangle(FaceId f) const { return mesh_.triangles()[index(f)]; }
  Sign side(const Plane& plane, std::uint32_t v) const {
    if (v == plane[0] || v == plane[1] || v == plane[2]) return Sign::kZero;
    const std::span<const Vec3> p = mesh_.positions();
    return orient3d(p[plane[0]], p[plane[1]], p[plane[2]], p[v]);
  }
  bool is_none_beyond(const Plane& plane, std::span<const std::uint32_t> vertices) const {
    return std::none_of(vertices.begin(), vertices.end(),
                        [&](std::uint32_t v) { return side(plane, v) == Sign::kPositive; });
  }
  bool is_none_behind(const Plane& plane, std::span<const std::uint32_t> vertices) const {
    return std::none_of(vertices.begin(), vertices.end(),
                        [&](std::uint32_t v) { return side(plane, v) == Sign::kNegative; });
  }

  ConvexPatch grow_from(FaceId seed) {
    patch_ = {};
    box_ = {};
    neighbors_.clear();
    ++number_;
    free_[index(seed)] = false;
    if (!try_to_add(seed)) return {{seed}, {triangle(seed).begin(), triangle(seed).end()}};
    for (std::size_t i = 0; i < patch_.faces.size(); ++i) {
      for (const FaceId next : faces_around(patch_.faces[i])) {
        if (patch_.faces.size() == kMostFaces || !free_[index(next)] || refused_by_[index(next)] == number_)
          continue;
        if (try_to_add(next)) {
          free_[index(next)] = false;
        } else {
          refused_by_[index(next)] = number_;
        }
      }
    }
    return patch_;
  }

  std::array<FaceId, 3> faces_around(FaceId f) const {
    std::array<FaceId, 3> faces;
    for (int i = 0; i < 3; ++i) {
      const Edge& edge = mesh_.edges()[index(mesh_.face_edges()[index(f)][i])];
      faces[i] = edge.left == f ? edge.right : edge.left;
    }
    std::sort(faces.begin(), faces.end(),
              [&](FaceId g, FaceId h) { return rank_[index(g)] < rank_[index(h)]; });
    return faces;
  }

  /// Adds a face if the hull then still is proved to have no other face in its interior.
  bool try_to_add(FaceId added) {
    faces_ = patch_.faces;
    vertices_ = patch_.vertices;
    corners_.clear();
    for (const std::uint32_t v : triangle(added)) {
      if (std::find(vertices_.begin(), vertices_.end(), v) == vertices_.end()) corners_.push_back(v);
    }
    faces_.push_back(added);
    vertices_.insert(vertices_.end(), corners_.begin(), corners_.end());
    if (!stays_convex(added)) return false;
    Bounds box = box_;
    for (const std::uint32_t v : corners_) box.add(mesh_.positions()[v]);
    if (!neighbors_stay_outside(added, box)) return false;
    patch_.faces.swap(faces_);
    patch_.vertices.swap(vertices_);
    box_ = box;
    neighbors_.swap(updated_);
    for (const Neighbor& n : neighbors_) patch_near_[index(n.face)] = number_;
    return true;
  }

  /// No vertex is beyond a face of the patch.
  bool stays_convex(FaceId added) const {
    return is_none_beyond(triangle(added), vertices_) &&
           std::all_of(faces_.begin(), faces_.end(),
                       [&](FaceId f) { return is_none_beyond(triangle(f), corners_); });
  }

  /// Leaves the proofs in `updated_`.
  bool neighbors_stay_outside(FaceId added, const Bounds& box) {
    updated_.clear();
    for (Neighbor n : neighbors_) {
      if (n.face == added) continue;
      if (!is_none_beyond(n.plane, corners_) && !find_plane(n)) return false;
      updated_.push_back(n);
    }
    return tree_->for_each_near(box, [&](FaceId f) {
      if (patch_near_[index(f)] == number_ || std::find(faces_.begin(), faces_.end(), f) != faces_.end())
        return true;
      Neighbor n{f, {}};
      if (!find_plane(n)) return false;
      updated_.push_back(n);
      return true;
    });
  }

  /// Planes of faces, then such through an edge and a vertex. A plane that has the whole patch in it is good
  /// for one of the patch's faces only: for a flat patch it must have the right side outside.
  bool find_plane(Neighbor& n) const {
    const IndexedTriangle& t = triangle(n.face);
    for (const FaceId f : faces_) {
      if (is_none_behind(triangle(f), t)) return n.plane = triangle(f), true;
    }
    if (try_plane(t, n) || try_plane({t[0], t[2], t[1]}, n)) return true;
    for (int i = 0; i < 3; ++i) {
      for (const std::uint32_t v : vertices_) {
        if (try_both({t[i], t[(i + 1) % 3], v}, n)) return true;
      }
    }
    for (const FaceId f : faces_) {
      const IndexedTriangle& own = triangle(f);
      for (int i = 0; i < 3; ++i) {
        for (const std::uint32_t v : t) {
          if (try_both({own[i], own[(i + 1) % 3], v}, n)) return true;
        }
      }
    }
    const std::span<const Vec3> p = mesh_.positions();
    return collinear(p[t[0]], p[t[1]], p[t[2]]);
  }

  bool try_both(const Plane& plane, Neighbor& n) const {
    return try_plane(plane, n) || try_plane({plane[0], plane[2], plane[1]}, n);
  }

  bool try_plane(const Plane& plane, Neighbor& n) const {
    bool strictly = false;
    for (const std::uint32_t v : vertices_) {
      const Sign s = side(plane, v);
      if (s == Sign::kPositive) return false;
      strictly = strictly || s == Sign::kNegative;
    }
    if (!strictly || !is_none_behind(plane, triangle(n.face))) return false;
    n.plane = plane;
    return true;
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> rank_;        ///< per face
  const FaceTree* tree_ = nullptr;         ///< of the component
  std::vector<char> free_;                 ///< per face: a member in no patch yet
  std::vector<std::uint32_t> patch_near_;  ///< per face: the number of the last patch it was near to
  std::vector<std::uint32_t> refused_by_;  ///< per face: the last patch that it could not join
  std::uint32_t number_ = 0;               ///< of the patch that grows
  ConvexPatch patch_;
  Bounds box_;
  std::vector<Neighbor> neighbors_;
  // The same with the face that is to be added:
  std::vector<FaceId> faces_;
  std::vector<std::uint32_t> vertices_, corners_;  ///< corners_: those of vertices_ that are new
  std::vector<Neighbor> updated_;
};

PatchFinder::PatchFinder(const TriangleMesh& mesh) : grower_(std::make_unique<Grower>(mesh)) {}
PatchFinder::~PatchFinder() = default;

std::vector<ConvexPatch> PatchFinder::find(const FaceTree& component, std::span<const FaceId> members,
                                           const std::function<void(const ConvexPatch&)>& after_each) {
  return grower_->run(component, members, after_each);
}

}  // namespace penumbra::detail
