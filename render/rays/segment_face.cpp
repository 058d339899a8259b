#include "render/rays/segment_face.h"

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {
namespace {

/// On which side the line from x to q passes the edge.
int side_of_edge(const Vec3& x, const Vec3& q, const Vec3& from, const Vec3& to) {
  return static_cast<int>(orient3d(x, q, from, to));
}

}  // namespace

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
