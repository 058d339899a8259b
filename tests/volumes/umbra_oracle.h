// Whether a convex caster hides the whole disk from a point, by its outline as seen from there: no plane
// through the point and an edge of the outline meets the open disk, and the center is hidden. In doubles
// where they leave no doubt, else in rationals; nothing of the library's volumes or predicates in it.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"
#include "tests/volumes/shadow_oracle.h"

namespace penumbra::testing {

class UmbraOracle {
 public:
  /// One closed convex component strictly in front of the light; radius above 0.
  UmbraOracle(const TriangleMesh& mesh, const CircularLight& light) : mesh_(mesh), light_(light) {}

  bool is_wholly_hidden(const Vec3& x) {
    constexpr double kSlack = 1e-9;
    const Answer quick = hides<double>(x, kSlack);
    if (quick != Answer::kUnsure) return quick == Answer::kYes;
    ++exact_decisions_;
    return hides<Rational>(x, 0.0) == Answer::kYes;
  }
  std::size_t exact_decisions() const { return exact_decisions_; }

 private:
  template <class N>
  Answer hides(const Vec3& at, double slack) const {
    const Vector<N> x = vector_of<N>(at), m = vector_of<N>(light_.normal),
                    to_center = light_.is_distant() ? center<N>() : minus(center<N>(), x);
    bool unsure = false;
    const auto sign = [&](const N& v, const N& scale2) {
      if (slack > 0 && !(v * v > scale2 * N(slack * slack))) unsure = true;
      return v > 0 ? 1 : v < 0 ? -1 : 0;
    };
    std::vector<int> sees;
    for (const IndexedTriangle& t : mesh_.triangles()) {
      const Vector<N> a = corner<N>(t[0]), n = outer(minus(corner<N>(t[1]), a), minus(corner<N>(t[2]), a));
      const Vector<N> to_x = minus(x, a);
      sees.push_back(sign(inner(n, to_x), N(inner(n, n) * inner(to_x, to_x))) > 0);
    }
    if (unsure) return Answer::kUnsure;
    const N mm = inner(m, m),
            radius2 = N(light_.radius) * N(light_.radius) * (light_.is_distant() ? mm : N(1));
    for (const Edge& e : mesh_.edges()) {
      const bool left = sees[index(e.left)] != 0, right = sees[index(e.right)] != 0;
      if (left == right) continue;
      const VertexId from = left ? e.from : e.to, to = left ? e.to : e.from;
      const Vector<N> n = outer(minus(corner<N>(static_cast<std::uint32_t>(from)), x),
                                minus(corner<N>(static_cast<std::uint32_t>(to)), x));
      const N d = inner(n, to_center);
      const Vector<N> across = outer(n, m);
      // Inside of the outline is where n·(p - x) < 0.
      const N reach2 = radius2 * inner(across, across), d2 = d * d * mm;
      const int outside = sign(d, N(inner(n, n) * inner(to_center, to_center)));
      const N sum = d2 + reach2;
      const int clear = sign(N(d2 - reach2), N(sum * sum));
      if (unsure) return Answer::kUnsure;
      if (outside >= 0 || clear < 0) return Answer::kNo;
    }
    return Answer::kYes;  // also inside of the caster, where no face is seen
  }

  template <class N>
  Vector<N> corner(std::uint32_t v) const {
    return vector_of<N>(mesh_.positions()[v]);
  }
  template <class N>
  Vector<N> center() const {
    return vector_of<N>(light_.center);
  }

  const TriangleMesh& mesh_;
  CircularLight light_;
  std::size_t exact_decisions_ = 0;
};

}  // namespace penumbra::testing
