// D-buffer step 3: which parts of the D-buffer the image's receivers will read. Nothing is drawn for the
// others.
//
// In: receivers, and which of them see the light's center. Out: for any rectangle of (u, v) the height h down
// to which entries are read there. A texel is read only by receivers on its line of sight. Those that see the
// light's center read penumbra entries, the others umbra entries. An entry counts only for receivers behind
// it. So a boundary changes no pixel if its bounds hold no such receiver, and need not go on behind the
// farthest that they hold. Not in the 2004 paper.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "penumbra/volumes/supports.h"
#include "render/d_buffer/view/targets.h"

namespace penumbra::detail {

/// The image's receivers in light space: ReceiverTexels (render/d_buffer/view/receivers_in_light.h).
struct ImageReceivers {
  int width, height;
  std::span<const glm::vec4> positions, planes;
};

class ReceiverGrid {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  /// Speed: cells a side of the grid over the target's window. More: fewer boundaries are drawn in vain, and
  /// the grid takes longer to make (d_buffer_bench). At most 256, see Reads.
  static constexpr int kCells = 256;

  /// What one pixel reads.
  struct Reads {
    /// Its cell.
    std::uint8_t column = 0, row = 0;
    /// Entries of which kind.
    bool penumbra = false, umbra = false;
    bool any() const { return penumbra || umbra; }
  };

  /// Receivers everywhere, as far away as can be: every entry may be read.
  ReceiverGrid() = default;
  /// The receivers of an image in the only target. `seen`: as from CenterRays::center_seen; `size`: texels a
  /// side of the target. Cost O(pixels), on all cores.
  ReceiverGrid(const ImageReceivers& image, std::span<const float> seen, const Target& target, int size);

  bool is_everywhere() const { return levels_.empty(); }
  /// A lower bound of h of the receivers within `bounds` that read entries of this kind: what is not higher
  /// is not read there. kNone where there is no such receiver. Cost O(1).
  double least_height(SupportKind kind, const UvBounds& bounds) const;
  /// One a pixel; none for receivers everywhere.
  std::span<const Reads> reads() const { return reads_; }

 private:
  /// Least h by cell, of penumbra and umbra entries that are read.
  using Kinds = std::array<std::vector<float>, 2>;
  void build_levels(Kinds finest);

  std::vector<Reads> reads_;
  /// Each has half the cells a side of the one before.
  std::vector<Kinds> levels_;
  glm::dvec2 low_{0.0}, cells_per_unit_{0.0};
  /// A texel's width in cells.
  double texel_ = 0.0;
};

}  // namespace penumbra::detail
