#include "render/rays/segment_face.h"

#include <array>
#include <glm/geometric.hpp>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {
namespace {

/// On which side the line from x to q passes the edge.
int side_of_edge(const Vec3& x, const Vec3& q, const Vec3& from, const Vec3& to) {
  return static_cast<int>(orient3d(x, q, from, to));
}

/// Along a surface, on both sides of which lies a plane that holds the segment.
class Walk {
 public:
  Walk(const ScaledMesh& mesh, const Vec3& x, const Vec3& q, const Vec3& normal)
      : mesh_(mesh),
        x_(x),
        length_(glm::length(q - x)),
        along_((q - x) / length_),
        across_(glm::cross(along_, normal)) {}

  /// Where the plane cuts a side of a face.
  struct Crossing {
    std::size_t side;
    Vec3 at;
  };
  /// The two sides of a face that are cut, or none. A vertex in the plane counts as on its left.
  std::optional<std::array<Crossing, 2>> crossings(std::uint32_t face) const {
    const FaceCorners c = mesh_.corners(face);
    const std::array<Vec3, 3> p{c.a, c.b, c.c};
    std::array<double, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = glm::dot(p[k] - x_, across_);
    std::array<Crossing, 2> out;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if ((v[k] >= 0.0) == (v[next] >= 0.0)) continue;
      out[count++] = {k, p[k] + v[k] / (v[k] - v[next]) * (p[next] - p[k])};
    }
    if (count == 0) return std::nullopt;
    return out;
  }
  double place(const Crossing& c) const { return glm::dot(c.at - x_, along_); }
  bool is_close(const Crossing& c, double reach) const {
    const double at = place(c);
    return at > -reach && at < length_ + reach && glm::distance(c.at - x_, at * along_) < reach;
  }

 private:
  const ScaledMesh& mesh_;
  Vec3 x_;
  double length_;
  Vec3 along_, across_;
};

/// The face beyond a side of a face; none at a boundary.
std::optional<std::uint32_t> face_beyond(const TriangleMesh& mesh, EdgeId edge, std::uint32_t face) {
  const Edge& e = mesh.edges()[index(edge)];
  if (e.is_boundary()) return std::nullopt;
  return static_cast<std::uint32_t>(index(index(e.left) == face ? e.right : e.left));
}

}  // namespace

FaceCorners ScaledMesh::corners(std::uint32_t face) const {
  const IndexedTriangle& t = mesh.triangles()[face];
  const auto p = mesh.positions();
  return {p[t[0]] * scale, p[t[1]] * scale, p[t[2]] * scale};
}

std::optional<std::uint32_t> hiding_face_along(const ScaledMesh& mesh, std::uint32_t face, std::int64_t own,
                                               const Vec3& x, const Vec3& q, const WalkLimits& limits) {
  const FaceCorners first = mesh.corners(face);
  const Walk walk(mesh, x, q, glm::cross(first.b - first.a, first.c - first.a));
  const auto start = walk.crossings(face);
  if (!start) return std::nullopt;
  const bool second = walk.place((*start)[1]) > walk.place((*start)[0]);  // which lies ahead
  for (const bool forward : {true, false}) {
    if (!forward && limits.forward_only) break;
    Walk::Crossing way_out = (*start)[second == forward ? 1 : 0];
    std::uint32_t at = face;
    for (int step = 0; step < limits.faces && walk.is_close(way_out, limits.reach); ++step) {
      const EdgeId edge = mesh.mesh.face_edges()[at][way_out.side];
      const auto next = face_beyond(mesh.mesh, edge, at);
      if (!next) break;
      const FaceCorners corners = mesh.corners(*next);
      if (*next != own && separates(corners, x, q) && line_meets(corners, x, q)) return next;
      const auto sides = walk.crossings(*next);
      if (!sides) break;
      way_out = (*sides)[mesh.mesh.face_edges()[*next][(*sides)[0].side] == edge ? 1 : 0];
      at = *next;
    }
  }
  return std::nullopt;
}

bool separates(const FaceCorners& face, const Vec3& x, const Vec3& q) {
  const int side = side_of_plane(face, x);
  return side != 0 && side_of_plane(face, q) == -side;
}

bool line_meets(const FaceCorners& face, const Vec3& x, const Vec3& q) {
  const int first = side_of_edge(x, q, face.a, face.b);
  const int second = side_of_edge(x, q, face.b, face.c);
  if (first * second < 0) return false;
  const int third = side_of_edge(x, q, face.c, face.a);
  if (first * third < 0 || second * third < 0) return false;
  return first != 0 || second != 0 || third != 0;
}

}  // namespace penumbra::detail
