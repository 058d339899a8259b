// Which parts of the D-buffer the image's receivers will read, so that nothing is drawn for the others.
//
// A texel is read only by receivers on its line of sight; those that see the light's center read penumbra
// entries, the others umbra entries; and an entry counts only for receivers behind it. So a boundary whose
// bounds in (x/z, y/z) hold no such receiver changes no pixel, and one that holds some need not go on behind
// the farthest of them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <vector>

#include "penumbra/volumes/supports.h"
#include "render/d_buffer/entries/targets.h"

namespace penumbra::detail {

/// The image's receivers in a frame that axes and offset turn into the light's; the fourth number is 0 where
/// nothing is seen.
struct ImageReceivers {
  int width, height;
  std::span<const glm::vec4> positions;
  glm::mat3 axes;
  glm::vec3 offset;
};

/// A rectangle in (x/z, y/z).
struct UvBounds {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec2& uv) {
    low = glm::min(low, uv);
    high = glm::max(high, uv);
  }
};

class ReceiverGrid {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  static constexpr int kCells = 256;  ///< a side of the grid over the target's window

  /// What one pixel reads.
  struct Reads {
    std::uint8_t column = 0, row = 0;      ///< its cell
    bool penumbra = false, umbra = false;  ///< entries of which kind
    bool any() const { return penumbra || umbra; }
  };

  /// Receivers everywhere, as far away as can be.
  ReceiverGrid() = default;
  /// Those of an image in the only target of `size` texels a side around a disk of the given radius; `seen`
  /// as from CenterRays::center_seen, `normals` in the scene's frame. Cost O(pixels), on all cores.
  ReceiverGrid(const ImageReceivers& image, std::span<const glm::vec4> normals, std::span<const float> seen,
               const Target& target, int size, double radius);

  bool is_everywhere() const { return levels_.empty(); }
  /// A number that no receiver of entries of this kind within the bounds is below: entries of no greater 1/z
  /// are not read. kNone where there is no such receiver. Cost O(1).
  double least_weight(SupportKind kind, const UvBounds& bounds) const;
  /// One per pixel; none for receivers everywhere.
  std::span<const Reads> reads() const { return reads_; }

 private:
  /// Least 1/z by cell, of penumbra and umbra entries that are read.
  using Kinds = std::array<std::vector<float>, 2>;
  void build_levels(Kinds finest);

  std::vector<Reads> reads_;
  std::vector<Kinds> levels_;  ///< each halves the cells a side of the one before
  glm::dvec2 low_{0.0}, cells_per_unit_{0.0};
  double texel_ = 0.0;  ///< in cells
};

}  // namespace penumbra::detail
