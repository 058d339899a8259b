// D-buffer step 8: pixels whose visibility contradicts their neighbors' is sampled by rays and put right.
//
// In: an image's surface points and their visibility by entries. Out: the visibility, changed where rays deny
// it.
//
// Why. A texel keeps one entry of a kind (or two). Where two boundaries compete, receivers side by side read
// different ones, and visibility jumps; but on a surface it is continuous, except where something touches the
// surface. So a jump tells where entries are wrong: leaks, penumbras of edges that something else hides,
// seams between texels' entries.
//
// How.
//   1. Three kinds of pixels are sampled: those given by the caller, both sides of each jump, and probe
//      pixels at even distances, which find surfaces where all entries are wrong and nothing contradicts
//      anything.
//   2. Each ray is compared with what the entries say of its point of the disk (seen_boundary.h). Where no
//      ray denies the entries they stay: where they are exact, no noise of rays gets into the picture.
//   3. Where a ray denies the entries, the neighbors on the same surface are sampled too, until none does. So
//      errors are found up to where one pixel in two or three has a ray in the part of the disk that is
//      wrong.
//   4. The mean of the samples around a pixel takes the place of what entries say, as far as noise does not
//      explain the difference. Neighbors are sampled at different points of the light, so that this mean has
//      little noise (interleaved sampling, A. Keller and W. Heidrich 2001). Where there are no neighbors to
//      average with (the picture's border, creases, leaves) the pixel itself is sampled at all points.
// None of this is in the 2004 paper.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "penumbra/render/receivers/receivers.h"

namespace penumbra::detail {

/// The surface points of an image.
struct ImageSurface {
  /// Pixels, with normals.
  Receivers receivers;
  /// The disk's fraction above the horizon. Visibilities are compared as parts of it: it jumps where normals
  /// do, which is no contradiction.
  std::span<const float> open;
};

/// What rays say of a pixel.
struct RaySample {
  /// V by entries, put right by what rays find otherwise.
  float visibility;
  /// A ray found otherwise.
  bool denies;
  /// No ray sees the light, or each one that is above the horizon does.
  bool is_dark = false, is_lit = false;
};
/// Each pixel's own points of the disk, or those of all three by three neighbors.
enum class SamplePoints { kOwn, kAll };
/// Samples of the given pixels, in their order. The errors of neighbors' own points must be independent.
using SampleVisibility = std::function<std::vector<RaySample>(std::span<const std::uint32_t>, SamplePoints)>;

/// Accuracy and speed: a greater difference between neighbors (of visibility as a part of what is open) is a
/// jump. Less may be the slope of a narrow penumbra, which would be sampled in vain. Held by
/// Resampler.SlopesAndEdgesOfSurfacesAreNoJumps and Resampler.LessensTheError.
inline constexpr float kDiscontinuity = 0.07f;

/// Pixels that see a surface which at most one of their four neighbors sees too, ascending: leaves and
/// needles, where wrong entries contradict nothing. Cost O(pixels), on all cores.
std::vector<std::uint32_t> isolated_pixels(const ImageSurface& image);

/// Keeps its memory from one image to the next, nothing else.
class Resampler {
 public:
  /// Puts `visibility`, one per pixel by entries, right.
  ///
  /// `always` are sampled in any case; so are both sides of every jump between neighbors on one surface, and
  /// the neighbors of every pixel where samples deny the entries, and probe pixels. `always` must see a
  /// surface. Returns how many were sampled. Cost O(pixels) and the samples, on all cores.
  std::size_t resample(const ImageSurface& image, std::span<const std::uint32_t> always,
                       const SampleVisibility& sample, std::span<float> visibility);

 private:
  void begin();
  /// The pixels to be sampled first, ascending: those given, both sides of jumps, and probe pixels.
  std::vector<std::uint32_t> find_first(std::span<const std::uint32_t> always) const;
  std::vector<std::uint32_t> probe_pixels() const;
  /// Both sides of the jumps between a row's pixels, and from them to the next row's.
  void find_in_row(int y, std::vector<std::uint32_t>& out) const;
  /// The same between each of `count` pixels from `begin` on and the pixel that is `apart` further on.
  void find_between(std::uint32_t begin, std::uint32_t count, std::uint32_t apart,
                    std::vector<std::uint32_t>& out) const;
  bool is_discontinuity(std::uint32_t i, std::uint32_t j) const;
  /// Takes the samples of `pixels`; returns the pixels to be sampled next: neighbors of those where a ray
  /// denies the entries.
  std::vector<std::uint32_t> take(std::span<const std::uint32_t> pixels, std::span<const RaySample> samples);
  void take_sample(std::uint32_t pixel, const RaySample& sample);
  struct Mean {
    float visibility;
    /// Mean absolute difference from what entries say.
    float correction;
    int samples;
    /// All samples are dark, or all lit: the mean has hardly any noise.
    bool is_uniform = false;
    /// How far apart the means are of which this is one.
    float bend = 0.0f;
  };
  /// The mean of the values of a pixel and of sampled ones on flat ground around it. Each counts by how much
  /// of the disk is above its horizon, and opposite pixels count together, so that a slope does not shift the
  /// mean.
  template <class Value>
  Mean mean_of(std::uint32_t i, const Value& value) const;
  /// The mean of visibility by rays, or what entries say and the mean of what rays correct. Where visibility
  /// is bent, as in a narrow penumbra, the first is wrong by the bend; where entries jump, the second by the
  /// jump, which their corrections do as well. So the second is taken where what entries say is bent by more
  /// than twice the corrections, if it is nearer to the pixel's own sample.
  Mean mean_sample(std::uint32_t i) const;
  bool is_denied_around(std::uint32_t i) const;
  /// By the entries; does not change while pixels are put right.
  float by_entries(std::uint32_t i) const { return share_[i] * image_.open[i]; }
  /// How far the mean of the samples is from what entries say; above 1 the noise of the samples does not
  /// explain it. 0 where no ray denies the entries.
  float difference(std::uint32_t i, const Mean& mean) const;
  /// How far the mean takes the place of what entries say: 0 to 1.
  float weight_of(std::uint32_t i, const Mean& mean) const;
  /// Sixteen points are too few: there are no neighbors all round to average with, or the means differ.
  /// Leaves are left at that, and twigs and outlines where rays deny entries beyond doubt: in a tree they
  /// would take longer than all the rest.
  bool is_doubtful(std::uint32_t i) const;
  /// Samples these at all points.
  void sample_thoroughly(const SampleVisibility& sample);
  /// Replaces the visibility of sampled pixels by the mean of the samples, wholly or in part.
  void settle();

  /// This and the next only during a call.
  ImageSurface image_;
  std::span<float> visibility_;
  /// Of each pixel: visibility by entries as a part of what is open; visibility by rays, negative if not
  /// sampled, and its difference from what entries say.
  std::vector<float> share_, sample_, correction_;
  std::vector<char> denies_, is_dark_, is_lit_, is_asked_, is_thorough_;
  std::vector<std::uint32_t> sampled_;
};

}  // namespace penumbra::detail
