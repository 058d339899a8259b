// Method view-samples, step masks: which samples of the light the faces hide from a receiver.
//
// In: a receiver x, the samples s of its light, one face after the other. Out: a mask of the samples that are
// hidden.
//
// Each edge a b of a face cuts the light along a line, by the plane through x, a and b. On which side of it a
// sample lies is the sign of det(a - x, b - x, s - x): a mask of a half-plane. With A, B, C the ways to the
// corners and D = det(A, B, C), a face hides the samples at which all three determinants have the sign of D:
// the masks of three half-planes, and-ed. The masks of all faces are or-ed. A face that runs through the
// light's plane hides those only that lie behind it, |D| < |sum of the three|.
//
// A face whose three half-planes hold the whole light hides all of it; one with a half-plane that holds none
// hides none. Two faces with a common edge compute the same product for it, with opposite signs: no sample
// slips between them.
//
// A mask has one lane a sample, not one bit, so that the loop is compiled for the processor's vectors.
#pragma once

#include <cstdint>
#include <vector>

#include "render/light/area_light.h"
#include "render/light/light_samples.h"
#include "render/silhouette/edges/unit_light.h"
#include "render/support/plane_side.h"

namespace penumbra::detail {

/// One receiver of the light.
struct MaskReceiver {
  /// In the light's frame.
  Vec3 x;
  /// To the light's center (AreaLight::from_receiver), and the unit normal, 0 where nothing lies below a
  /// horizon; in the world.
  Vec3 to_center, normal;
  /// The stream of its samples.
  std::uint32_t key;
};

/// How a face lies to the light as a receiver sees it.
enum class Cover { kNone, kSome, kAll };

/// A face as a receiver sees it: the normals of the planes through its edges and the receiver, turned so that
/// what the face hides is on their positive sides.
struct FaceCone {
  FaceCone(const FaceCorners& face, const Vec3& x);

  /// By the unit disk.
  Cover cover(const Vec3& x) const;

  Vec3 ab, bc, ca;
  /// D, not negative; what rounding may make of it.
  double depth, depth_error;
  /// Some of it is not in front of the light's plane.
  bool reaches_behind;
};

class SampleMasks {
 public:
  /// `unit`: the frame of a disk that holds the light. Refers to both.
  SampleMasks(const AreaLight& light, const UnitLight& unit, int samples);

  int count() const { return table_.strata.count(); }
  /// Places the samples; those below the horizon count as hidden.
  void begin(const MaskReceiver& receiver);
  /// Hides the samples behind a face. False where no sample is left.
  bool hide(const FaceCone& cone);
  /// Samples that are not hidden.
  int visible() const;

 private:
  const AreaLight& light_;
  StratumTable table_;
  /// Half axes of the light in the world, and on the unit disk.
  Vec3 u_, v_;
  glm::dvec2 unit_u_, unit_v_;
  /// One entry a sample, padded to whole lanes: place on the light; from the receiver to it, in the light's
  /// frame; -1 where it is hidden. What pads is hidden.
  std::vector<float> a_, b_;
  std::vector<double> x_, y_;
  double z_ = 0.0;
  std::vector<std::int64_t> hidden_;
};

}  // namespace penumbra::detail
