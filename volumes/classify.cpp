#include "penumbra/volumes/classify.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <algorithm>

#include "volumes/predicates/predicate_tiers.h"
#include "volumes/predicates/quick_class.h"

namespace penumbra {

namespace {

// Speed: faces that one task classifies.
constexpr std::size_t kFacesPerTask = 2048;
constexpr std::size_t kBlock = detail::QuickClassifier::Block::kFaces;

struct Corners {
  const Vec3 &a, &b, &c;
};

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

FaceClass classify_hard_face(const Corners& f, const CircularLight& light, TierTally& tally) {
  if (const auto decided = detail::filter::classify_face(f.a, f.b, f.c, light)) {
    ++tally.filter;
    return *decided;
  }
  if (const auto decided = detail::interval::classify_face(f.a, f.b, f.c, light)) {
    ++tally.interval;
    return *decided;
  }
  ++tally.exact;
  return detail::exact::classify_face(f.a, f.b, f.c, light);
}

/// Everything that the loop reads is a local of its own: stores of classes, being bytes, might otherwise
/// change it as far as the compiler knows.
Counts classify_some(const TriangleMesh& mesh, const CircularLight& light, std::size_t begin, std::size_t end,
                     FaceClass* out) {
  const detail::QuickClassifier quickly(light);
  const double bound = quickly.bound_of(mesh);
  const Vec3* positions = mesh.positions().data();
  const IndexedTriangle* triangles = mesh.triangles().data();
  Counts counts;
  std::size_t hard = 0;
  detail::QuickClassifier::Block block{};
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t count = std::min(kBlock, end - first);
    for (std::size_t i = 0; i < count; ++i) {
      const IndexedTriangle& t = triangles[first + i];
      for (int k = 0; k < 3; ++k) {
        block.a[k][i] = positions[t[0]][k];
        block.b[k][i] = positions[t[1]][k];
        block.c[k][i] = positions[t[2]][k];
      }
    }
    quickly.evaluate(block);
    for (std::size_t i = 0; i < count; ++i) {
      if (const auto quick = quickly.class_of(block, i, bound)) {
        out[first + i] = *quick;
        continue;
      }
      const IndexedTriangle& t = triangles[first + i];
      const Corners f{positions[t[0]], positions[t[1]], positions[t[2]]};
      if (const auto own = quickly(f.a, f.b, f.c)) {
        out[first + i] = *own;
      } else {
        ++hard;
        out[first + i] = classify_hard_face(f, light, counts.tally);
      }
    }
  }
  counts.tally.filter += end - begin - hard;
  for (int k = 0; k < 3; ++k)
    counts.classes[k] =
        static_cast<std::size_t>(std::count(out + begin, out + end, static_cast<FaceClass>(k)));
  return counts;
}

}  // namespace

Classification classify_faces(const TriangleMesh& mesh, const CircularLight& light) {
  Classification result;
  result.faces.resize(mesh.triangles().size());

  const auto classify_range = [&](const tbb::blocked_range<std::size_t>& range, const Counts& counts) {
    return sum(counts, classify_some(mesh, light, range.begin(), range.end(), result.faces.data()));
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
