// D-buffer step 8: pixels whose visibility contradicts their neighbors' is sampled by rays and put right.
//
// In: an image's surface points and their visibility by entries. Out: the visibility, changed where rays deny
// it.
//
// Why. A texel keeps one entry of a kind (or two). Where two boundaries compete, receivers side by side read
// different ones, and visibility jumps; but on a surface it is continuous, except where something touches the
// surface. So a jump tells where entries are wrong: leaks, penumbrae of edges that something else hides,
// seams between texels' entries.
//
// How.
//   1. Three kinds of pixels are sampled: those given by the caller, both sides of each jump, and probe pixels
//      at even distances, which find surfaces where all entries are wrong and nothing contradicts anything.
//   2. Where samples deny the entries, the neighbors on the same surface are sampled too, until they agree.
//   3. The mean of the samples around a pixel takes the place of what entries say, as far as noise does not
//      explain the difference. Neighbors are sampled at different points of the light, so that this mean has
//      little noise (interleaved sampling, A. Keller and W. Heidrich 2001).
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

/// Visibility of the given pixels by rays, in their order. The errors of neighbors must be independent.
using SampleVisibility = std::function<std::vector<float>(std::span<const std::uint32_t>)>;

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
  /// the neighbors of every pixel where samples deny the entries. `suspects` and probe pixels are sampled
  /// too, but one of them alone is believed less. Every pixel is sampled at most once, and only where a
  /// surface is seen. Returns how many were. Cost O(pixels) and the samples, on all cores.
  std::size_t resample(const ImageSurface& image, std::span<const std::uint32_t> always,
                       std::span<const std::uint32_t> suspects, const SampleVisibility& sample,
                       std::span<float> visibility);

 private:
  void begin();
  /// The pixels to be sampled first, ascending: those given, both sides of jumps, and probe pixels.
  std::vector<std::uint32_t> find_first(std::span<const std::uint32_t> always,
                                        std::span<const std::uint32_t> suspects);
  std::vector<std::uint32_t> probe_pixels() const;
  /// Both sides of the jumps between a row's pixels, and from them to the next row's.
  void find_in_row(int y, std::vector<std::uint32_t>& out) const;
  /// The same between each of `count` pixels from `begin` on and the pixel that is `apart` further on.
  void find_between(std::uint32_t begin, std::uint32_t count, std::uint32_t apart,
                    std::vector<std::uint32_t>& out) const;
  bool is_discontinuity(std::uint32_t i, std::uint32_t j) const;
  /// Takes the samples of `pixels`; returns the pixels to be sampled next. Pixels of the round before are
  /// looked at once more, since by now there are samples all around them.
  std::vector<std::uint32_t> take(std::span<const std::uint32_t> pixels, std::span<const float> samples);
  /// The mean of the samples on flat ground around a pixel. Each counts by how much of the disk is above its
  /// horizon, and opposite pixels count together, so that a slope does not shift the mean.
  struct Mean {
    float visibility;
    /// The same mean of what entries say. In a narrow penumbra it is not what they say in the middle.
    float by_entries;
    int samples;
  };
  Mean mean_sample(std::uint32_t i) const;
  /// By the entries; does not change while pixels are put right.
  float by_entries(std::uint32_t i) const { return share_[i] * image_.open[i]; }
  /// How far the mean of the samples is from what entries say; above 1 the noise of the samples does not
  /// explain it.
  float difference(std::uint32_t i, const Mean& mean) const;
  /// Replaces the visibility of sampled pixels by the mean of the samples, wholly or in part.
  void settle();

  /// This and the next only during a call.
  ImageSurface image_;
  std::span<float> visibility_;
  /// Of each pixel: visibility by entries as a part of what is open; visibility by rays, negative if not
  /// sampled.
  std::vector<float> share_, sample_;
  /// Why a pixel is sampled. Those sampled because of a neighbor have that neighbor's reason.
  enum Reason : char { kNotSampled, kContradiction, kProbe };
  std::vector<Reason> reason_;
  /// In the order of rounds, and how many there were before the last round.
  std::vector<std::uint32_t> sampled_;
  std::size_t before_ = 0;
  /// Of the pixels of the last two rounds: samples deny the entries.
  std::vector<char> denied_;
};

}  // namespace penumbra::detail
