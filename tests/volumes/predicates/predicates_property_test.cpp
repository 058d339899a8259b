// Every predicate against an oracle in GMP rationals on inputs that are degenerate on purpose; the tiers
// against each other; the laws that the header states. Prints how many inputs each tier decided.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "penumbra/volumes/classify.h"
#include "tests/volumes/predicates/oracles.h"
#include "tests/volumes/random_inputs.h"
#include "volumes/predicates/predicate_tiers.h"
#include "volumes/predicates/quick_class.h"

namespace penumbra {
namespace {

using testing::classify_oracle;
using testing::dot;
using testing::exact;
using testing::line_oracle;
using testing::PredicateInput;
using testing::RationalVec;
using testing::sign_of;
using testing::tangent_oracle;

constexpr std::uint64_t kSeed = 20040618;
/// PENUMBRA_LONG=1 in the environment asks for a million of each.
const int kInputs = std::getenv("PENUMBRA_LONG") ? 1'000'000 : 100'000;

/// With disks, and with distant lights.
class PredicatesProperty : public ::testing::TestWithParam<bool> {
 protected:
  bool distant() const { return GetParam(); }
  PredicateInput input(testing::RandomInputs& random, int k) const {
    return distant() ? testing::distant_input(random, k) : testing::predicate_input(random, k);
  }
};

INSTANTIATE_TEST_SUITE_P(Lights, PredicatesProperty, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "distant" : "disk"; });

// ---- agreement
// --------------------------------------------------------------------------------------------------------

struct Tally {
  int filter = 0, interval = 0, exact = 0, disagreements = 0;
};

/// Compares whatever each tier returns with the truth.
template <class Result>
void count(Tally& tally, const std::optional<Result>& filter, const std::optional<Result>& interval,
           Result exact_tier, Result predicate, Result truth) {
  ++(filter ? tally.filter : interval ? tally.interval : tally.exact);
  const bool agree = (!filter || *filter == truth) && (!interval || *interval == truth) &&
                     exact_tier == truth && predicate == truth;
  if (!agree) ++tally.disagreements;
}

void expect_agreement(const std::string& name, const Tally& tally, bool any_hard = true) {
  std::cout << "  " << name << ": filter " << tally.filter << ", interval " << tally.interval << ", exact "
            << tally.exact << ", disagreements " << tally.disagreements << "\n";
  EXPECT_EQ(tally.disagreements, 0) << name << ", seed " << kSeed;
  EXPECT_GT(tally.filter, 0);
  EXPECT_EQ(tally.exact > 0, any_hard);
}

TEST_P(PredicatesProperty, ClassifyFaceAgreesWithRationals) {
  testing::RandomInputs random(kSeed);
  Tally tally;
  int quick_decisions = 0;
  for (int k = 0; k < kInputs; ++k) {
    const auto in = input(random, k);
    const auto& p = in.p;
    if (const auto quick = detail::QuickClassifier(in.light)(p[0], p[1], p[2])) {
      ++quick_decisions;
      ASSERT_EQ(*quick, classify_oracle(in)) << "seed " << kSeed << " input " << k;
    }
    count(tally, detail::filter::classify_face(p[0], p[1], p[2], in.light),
          detail::interval::classify_face(p[0], p[1], p[2], in.light),
          detail::exact::classify_face(p[0], p[1], p[2], in.light), classify_face(p[0], p[1], p[2], in.light),
          classify_oracle(in));
  }
  std::cout << "  quick filter: " << quick_decisions << "\n";
  EXPECT_GT(quick_decisions, kInputs / 10);
  expect_agreement("classify_face", tally);
}

/// Meshes are classified with one error bound for all their faces first, then each with its own.
TEST_P(PredicatesProperty, MeshesAreClassifiedLikeTheirFaces) {
  const std::vector<IndexedTriangle> tetrahedron{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  testing::RandomInputs random(kSeed);
  Tally tally;
  long by_mesh_bound = 0;
  for (int k = 0; k < kInputs / 4; ++k) {
    const auto in = input(random, k);
    const TriangleMesh mesh =
        TriangleMesh::build(in.p, tetrahedron, {.weld = false, .flip_inside_out = false});
    const Classification classes = classify_faces(mesh, in.light);
    tally.filter += static_cast<int>(classes.tally.filter);
    tally.interval += static_cast<int>(classes.tally.interval);
    tally.exact += static_cast<int>(classes.tally.exact);
    const detail::QuickClassifier quickly(in.light);
    detail::QuickClassifier::Block block{};
    for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
      const IndexedTriangle& t = mesh.triangles()[f];
      const PredicateInput face{in.light,
                                {mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]}};
      for (int i = 0; i < 3; ++i) {
        block.a[i][f] = face.p[0][i];
        block.b[i][f] = face.p[1][i];
        block.c[i][f] = face.p[2][i];
      }
      tally.disagreements += classes.faces[f] != classify_oracle(face);
    }
    quickly.evaluate(block);
    for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
      const auto quick = quickly.class_of(block, f, quickly.bound_of(mesh));
      by_mesh_bound += quick.has_value();
      tally.disagreements += quick && *quick != classes.faces[f];
    }
  }
  std::cout << "  one bound a mesh: " << by_mesh_bound << "\n";
  EXPECT_GT(by_mesh_bound, kInputs / 10);
  expect_agreement("classify_faces", tally);
}

TEST_P(PredicatesProperty, Orient3dAgreesWithRationals) {
  testing::RandomInputs random(kSeed + 1);
  Tally tally;
  for (int k = 0; k < kInputs; ++k) {
    const auto in = input(random, k);
    const auto& p = in.p;
    const RationalVec a = exact(p[0]);
    const Sign truth = sign_of(dot(cross(exact(p[1]) - a, exact(p[2]) - a), exact(p[3]) - a));
    count(tally, detail::filter::orient3d(p[0], p[1], p[2], p[3]),
          detail::interval::orient3d(p[0], p[1], p[2], p[3]), detail::exact::orient3d(p[0], p[1], p[2], p[3]),
          orient3d(p[0], p[1], p[2], p[3]), truth);
  }
  expect_agreement("orient3d", tally);
}

TEST_P(PredicatesProperty, SideOfLightPlaneAgreesWithRationals) {
  testing::RandomInputs random(kSeed + 2);
  Tally tally;
  for (int k = 0; k < kInputs; ++k) {
    auto in = input(random, k);
    if (k % 2) in.p[0].z = in.light.center.z;
    if (k % 4 == 1) random.nudge(in.p[0]);
    const Sign truth = distant()
                           ? Sign::kPositive
                           : sign_of(dot(exact(in.light.normal), exact(in.p[0]) - exact(in.light.center)));
    count(tally, detail::filter::side_of_light_plane(in.p[0], in.light),
          detail::interval::side_of_light_plane(in.p[0], in.light),
          detail::exact::side_of_light_plane(in.p[0], in.light), side_of_light_plane(in.p[0], in.light),
          truth);
  }
  expect_agreement("side_of_light_plane", tally, !distant());
}

/// Moves the line so that it passes through a rim point of the (lattice) disk where there is one.
void aim_at_rim(PredicateInput& in, testing::RandomInputs& random) {
  if (in.light.is_distant()) {
    in = testing::distant_tangent_input(random, true);
    if (random.integer(0, 1)) random.nudge(in.p[random.integer(0, 1)]);
    return;
  }
  if (in.light.normal.x != 0 || in.light.normal.y != 0) return;
  const double t = random.integer(0, 1) ? 0.6 : 0.8,
               s = t == 0.6 ? 0.8 : 0.6;  // exact for radius 5, nearly so else
  const Vec3 rim = in.light.center + in.light.radius * Vec3(t, s, 0);
  in.p[1] = rim + (rim - in.p[0]);
}

TEST_P(PredicatesProperty, LineOutsideDiskAgreesWithRationals) {
  testing::RandomInputs random(kSeed + 3);
  Tally tally;
  for (int k = 0; k < kInputs; ++k) {
    auto in = input(random, k);
    if (k % 4 >= 2) aim_at_rim(in, random);
    if (in.p[0] == in.p[1]) continue;
    const auto& p = in.p;
    count(tally, detail::filter::line_outside_disk(p[0], p[1], in.light),
          detail::interval::line_outside_disk(p[0], p[1], in.light),
          detail::exact::line_outside_disk(p[0], p[1], in.light), line_outside_disk(p[0], p[1], in.light),
          line_oracle(in));
  }
  expect_agreement("line_outside_disk", tally);
}

TEST_P(PredicatesProperty, SideOfTangentPlaneAgreesWithRationals) {
  testing::RandomInputs random(kSeed + 4);
  Tally tally;
  int zeros = 0;
  for (int k = 0; tally.filter + tally.interval + tally.exact < kInputs; ++k) {
    const auto in = input(random, k);
    const auto& p = in.p;
    if (p[0] == p[1] || line_oracle(in) != Sign::kPositive) continue;
    const Tangent which = random.integer(0, 1) ? Tangent::kFirst : Tangent::kSecond;
    const auto truth = tangent_oracle(in, which);
    if (!truth) continue;
    if (*truth == Sign::kZero) ++zeros;
    const auto chosen = [&](const std::optional<std::array<Sign, 2>>& sides) {
      return sides ? std::optional((*sides)[static_cast<std::size_t>(which)]) : std::nullopt;
    };
    count(tally, chosen(detail::filter::sides_of_tangent_planes(p[0], p[1], p[2], in.light)),
          chosen(detail::interval::sides_of_tangent_planes(p[0], p[1], p[2], in.light)),
          *chosen(detail::exact::sides_of_tangent_planes(p[0], p[1], p[2], in.light)),
          side_of_tangent_plane(p[0], p[1], p[2], which, in.light), *truth);
  }
  expect_agreement("side_of_tangent_plane", tally);
  EXPECT_GT(zeros, kInputs / 100);
}

TEST_P(PredicatesProperty, CollinearAgreesWithRationals) {
  testing::RandomInputs random(kSeed + 5);
  for (int k = 0; k < kInputs; ++k) {
    const auto in = input(random, k);
    const RationalVec n = cross(exact(in.p[1]) - exact(in.p[0]), exact(in.p[2]) - exact(in.p[0]));
    ASSERT_EQ(detail::collinear(in.p[0], in.p[1], in.p[2]), testing::is_zero(n))
        << "seed " << kSeed + 5 << " input " << k;
  }
}

// ---- laws
// -------------------------------------------------------------------------------------------------------------

TEST_P(PredicatesProperty, LawsOfClassifyFace) {
  testing::RandomInputs random(kSeed + 6);
  for (int k = 0; k < kInputs / 10; ++k) {
    const auto in = input(random, k);
    const auto& p = in.p;
    const FaceClass c = classify_face(p[0], p[1], p[2], in.light);
    const auto mirrored = static_cast<FaceClass>(2 - static_cast<int>(c));
    ASSERT_EQ(classify_face(p[1], p[2], p[0], in.light), c) << "seed " << kSeed + 6 << " input " << k;
    ASSERT_EQ(classify_face(p[1], p[0], p[2], in.light), mirrored) << "seed " << kSeed + 6 << " input " << k;
    CircularLight longer = in.light;
    longer.normal *= 4.0;
    if (distant()) longer.center *= 4.0;
    ASSERT_EQ(classify_face(p[0], p[1], p[2], longer), c) << "seed " << kSeed + 6 << " input " << k;
    if (distant()) {
      ASSERT_EQ(classify_face(4.0 * p[0], 4.0 * p[1], 4.0 * p[2], in.light), c)
          << "seed " << kSeed + 6 << " input " << k;
      continue;
    }
    CircularLight turned = in.light;
    turned.normal *= -1.0;
    ASSERT_EQ(classify_face(p[0], p[1], p[2], turned), c) << "seed " << kSeed + 6 << " input " << k;
  }
}

TEST_P(PredicatesProperty, LawsOfOrientationAndLines) {
  testing::RandomInputs random(kSeed + 7);
  for (int k = 0; k < kInputs / 10; ++k) {
    const auto in = input(random, k);
    const auto& p = in.p;
    const Sign s = orient3d(p[0], p[1], p[2], p[3]);
    ASSERT_EQ(orient3d(p[1], p[0], p[3], p[2]), s) << "seed " << kSeed + 7 << " input " << k;
    ASSERT_EQ(orient3d(p[1], p[0], p[2], p[3]), testing::opposite(s))
        << "seed " << kSeed + 7 << " input " << k;
    if (p[0] == p[1]) continue;
    ASSERT_EQ(line_outside_disk(p[0], p[1], in.light), line_outside_disk(p[1], p[0], in.light))
        << "seed " << kSeed + 7 << " input " << k;
  }
}

TEST_P(PredicatesProperty, LawsOfTangentPlanes) {
  testing::RandomInputs random(kSeed + 8);
  for (int k = 0; k < kInputs / 10; ++k) {
    const auto in = input(random, k);
    const auto& p = in.p;
    if (p[0] == p[1] || line_outside_disk(p[0], p[1], in.light) != Sign::kPositive) continue;
    const Sign first = side_of_tangent_plane(p[0], p[1], p[2], Tangent::kFirst, in.light);
    const Sign second = side_of_tangent_plane(p[0], p[1], p[2], Tangent::kSecond, in.light);
    ASSERT_EQ(side_of_tangent_plane(p[1], p[0], p[2], Tangent::kSecond, in.light), first)
        << "seed " << kSeed + 8 << " input " << k;
    ASSERT_EQ(side_of_tangent_plane(p[1], p[0], p[2], Tangent::kFirst, in.light), second)
        << "seed " << kSeed + 8 << " input " << k;
    const FaceClass c = classify_face(p[0], p[1], p[2], in.light);
    const bool beyond_first = first == Sign::kNegative && second == Sign::kPositive;
    const bool beyond_second = first == Sign::kPositive && second == Sign::kNegative;
    ASSERT_EQ(c == FaceClass::kAllFront, beyond_first) << "seed " << kSeed + 8 << " input " << k;
    ASSERT_EQ(c == FaceClass::kNoneFront, beyond_second) << "seed " << kSeed + 8 << " input " << k;
  }
}

}  // namespace
}  // namespace penumbra
