#include "volumes/classify.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "volumes/detail/predicate_tiers.h"

namespace penumbra {

namespace {

constexpr std::size_t kFacesPerTask = 2048;

struct Corners {
  const Vec3 &a, &b, &c;
};

Corners corners_of(const TriangleMesh& mesh, std::size_t face) {
  const IndexedTriangle& t = mesh.triangles()[face];
  return {mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]};
}

/// Counts of one range of faces; sums do not depend on how faces were divided.
struct Counts {
  std::array<std::size_t, 3> classes{};
  TierTally tally;
};

Counts sum(Counts a, const Counts& b) {
  for (int k = 0; k < 3; ++k) a.classes[k] += b.classes[k];
  a.tally.filter += b.tally.filter;
  a.tally.interval += b.tally.interval;
  a.tally.exact += b.tally.exact;
  return a;
}

FaceClass classify_hard_face(const Corners& f, const DiskLight& light, TierTally& tally) {
  if (const auto decided = detail::interval::classify_face(f.a, f.b, f.c, light)) {
    ++tally.interval;
    return *decided;
  }
  ++tally.exact;
  return detail::exact::classify_face(f.a, f.b, f.c, light);
}

}  // namespace

Classification classify_faces(const TriangleMesh& mesh, const DiskLight& light) {
  Classification result;
  result.faces.resize(mesh.triangles().size());

  const auto classify_range = [&](const tbb::blocked_range<std::size_t>& range, Counts counts) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Corners f = corners_of(mesh, i);
      const auto quick = detail::filter::classify_face(f.a, f.b, f.c, light);
      if (quick) ++counts.tally.filter;
      result.faces[i] = quick ? *quick : classify_hard_face(f, light, counts.tally);
      ++counts.classes[static_cast<std::size_t>(result.faces[i])];
    }
    return counts;
  };
  const Counts counts = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, result.faces.size(), kFacesPerTask), Counts{}, classify_range, sum);

  result.none_front = counts.classes[static_cast<std::size_t>(FaceClass::kNoneFront)];
  result.mixed = counts.classes[static_cast<std::size_t>(FaceClass::kMixed)];
  result.all_front = counts.classes[static_cast<std::size_t>(FaceClass::kAllFront)];
  result.tally = counts.tally;
  return result;
}

}  // namespace penumbra
