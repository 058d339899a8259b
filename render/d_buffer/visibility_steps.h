// Pixels whose visibility contradicts their neighbours', or what rays say.
//
// In a D-buffer a texel holds one entry a kind. Where two boundaries compete, receivers side by side read
// different ones, and their visibilities differ by a step. But visibility is continuous on a surface, except
// where something touches it; so a step says where entries are wrong, and what rays say of its pixels is
// carried on from neighbour to neighbour until it agrees with what entries say. Neighbours ask different
// points of the light, so that the mean of their answers has little noise (interleaved sampling, A. Keller
// and W. Heidrich 2001). Where all entries of a surface are wrong nothing contradicts them: so some pixels
// are asked at even distances, and what they find is carried on in the same way.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace penumbra::detail {

/// An image's surface; the fourth number of a position is 0 where nothing is seen. `open` is the visibility
/// that the horizon alone leaves: only what casters do to it is compared, since it jumps where normals do.
struct ImageSurface {
  int width = 0, height = 0;
  std::span<const glm::vec4> positions, normals;
  std::span<const float> open;
};

/// Visibility of the given pixels, in their order; what neighbours' answers err by is independent.
using AskVisibility = std::function<std::vector<float>(std::span<const std::uint32_t>)>;

/// More than this between neighbours is a step; less may be the slope of a narrow penumbra.
inline constexpr float kVisibilityStep = 0.07f;

/// Pixels that see a surface which at most one of their four neighbours sees too, ascending: leaves and
/// needles, where wrong entries contradict nothing. Cost O(pixels), on all cores.
std::vector<std::uint32_t> lonely_pixels(const ImageSurface& image);

/// Where rays are asked, and what becomes of their answers. Keeps its memory from one image to the next.
class VisibilitySteps {
 public:
  /// Asks about the pixels in `anyway`, about both sides of every step between neighbours on one surface,
  /// about a few at even distances (entries may be wrong all over a surface, and then contradict nothing),
  /// and about the neighbours of every pixel where the answers differ from `visibility` by more than their
  /// noise. Where they do, the mean of those on flat ground around a pixel takes its place, in opposite pairs
  /// so that a slope does not shift it; where they differ by less, only in part, so that no edge shows.
  /// Returns how many pixels were asked, each once; all of them see a surface. Cost O(pixels) and the
  /// answers, on all cores.
  /// Those in `suspects` are asked as well, and believed no more than those at even distances.
  std::size_t ask(const ImageSurface& image, std::span<const std::uint32_t> anyway,
                  std::span<const std::uint32_t> suspects, const AskVisibility& ask,
                  std::span<float> visibility);

 private:
  void begin();
  /// Those given, pixels on either side of a step, and sentinels, in the image's order.
  std::vector<std::uint32_t> find(std::span<const std::uint32_t> anyway,
                                  std::span<const std::uint32_t> suspects);
  /// Where something hides the light every eighth pixel of every eighth row, elsewhere one in four of these.
  std::vector<std::uint32_t> sentinels() const;
  /// Both sides of the steps between a row's pixels and to the next row's.
  void find_in_row(int y, std::vector<std::uint32_t>& out) const;
  /// Of `count` pixels from `begin` and those `apart` further on.
  void find_between(std::uint32_t begin, std::uint32_t count, std::uint32_t apart,
                    std::vector<std::uint32_t>& out) const;
  bool is_step(std::uint32_t i, std::uint32_t j) const;
  /// Takes what was said of the pixels; returns those to be asked next. The pixels of the time before are
  /// looked at once more, since now there are answers all around them.
  std::vector<std::uint32_t> take(std::span<const std::uint32_t> pixels, std::span<const float> said);
  /// What answers around a pixel say, and of how many it is the mean. They count by how much of the disk is
  /// above their horizon, and in opposite pairs, so that a slope does not shift it.
  struct Mean {
    float visibility;
    float by_entries;  ///< the same mean of what the entries say: in a narrow penumbra not what they say in
                       ///< its middle
    int answers;
  };
  Mean mean_answer(std::uint32_t i) const;
  /// By the entries; stays while pixels are settled.
  float visibility_of(std::uint32_t i) const { return share_[i] * image_.open[i]; }
  /// What is said of a pixel and around it against what the entries say, in units of what the answers' noise
  /// explains.
  float difference(std::uint32_t i, const Mean& mean) const;
  /// Puts what was said of a pixel and around it in place of what differs from it.
  void settle();

  ImageSurface image_;           ///< this and the next while asking
  std::span<float> visibility_;  ///< by the entries
  std::vector<float> share_;     ///< of what is above the horizon, by the entries
  std::vector<float> answer_;    ///< visibility by rays; negative where they were not asked
  enum Reason : char { kNotAsked, kDoubtful, kSentinel };
  std::vector<Reason>
      known_;  ///< why pixels were asked, or are about to be; neighbours of one for its reason
  std::vector<std::uint32_t> asked_;
  std::size_t before_ = 0;     ///< how many were asked before the last time
  std::vector<char> differs_;  ///< of those asked the last two times: the answers from the entries
};

}  // namespace penumbra::detail
