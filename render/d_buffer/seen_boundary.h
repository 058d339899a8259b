// D-buffer step 8: what entries say of single points of the disk.
//
// In: which entries the visibility shader used for a pixel, their records, the receiver. Out: whether a point
// of the disk is on their lit side. The boundary is followed from edge to edge as in
// shaders/d_buffer_boundary.glsl, whose twin this is: the shader gives the area, this the shape. So a ray can
// contradict an entry, however small the part of the disk is that they disagree about, and whatever noise a
// mean of rays has.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "penumbra/mesh/types.h"
#include "render/light/disk_area.h"

namespace penumbra::detail {

/// An entry that a pixel's visibility is from, as the shader writes it: 0 for none.
struct EntryUse {
  std::uint32_t code = 0;

  bool is_none() const { return code == 0; }
  /// The boundary was followed past its edge; else the edge's chord alone was taken, moved to the disk's
  /// center where it contradicts what is known of that.
  bool is_followed() const { return (code & 3u) == 1u; }
  bool is_umbra() const { return (code & 4u) != 0; }
  /// It contradicts what is known of the disk's center.
  bool is_uncertain() const { return (code & 8u) != 0; }
  std::uint32_t facet() const { return code >> 4; }
};

/// A boundary as one receiver sees it on the unit disk.
class SeenBoundary {
 public:
  /// `records`: as in EntryGeometry; `x`: the receiver in light space; `hidden`: it does not see the disk's
  /// center. Precondition: the use is not none.
  SeenBoundary(std::span<const glm::vec4> records, EntryUse use, const Vec3& x, bool hidden);
  bool is_lit(const glm::dvec2& point) const;

 private:
  /// From the edge's foot, the point of its line that is nearest to the center, past one end to where it
  /// leaves the disk.
  struct Walk {
    std::vector<glm::dvec2> points;
    bool closed = false;
    std::uint32_t last, next;  ///< facets
    /// Past a corner outside of the disk: the edge that comes back into it, and whether it adds to what is
    /// lit.
    std::optional<Chord> again;
    bool adds = false;
  };
  Walk walk(std::uint32_t facet, bool on, const glm::dvec2& way, Vec3 a, Vec3 b, const Vec3& x) const;
  bool is_left(const glm::dvec2& point) const;

  std::span<const glm::vec4> records_;
  Chord chord_;
  bool is_followed_, left_is_lit_ = false;
  Walk on_, back_;
};

/// What all entries of a pixel say together.
class SeenEntries {
 public:
  /// `uses`: two. The rest as of SeenBoundary.
  SeenEntries(std::span<const glm::vec4> records, std::span<const EntryUse> uses, const Vec3& x, bool hidden);
  bool is_lit(const glm::dvec2& point) const;
  /// Then the shader knows the area only as far as its chords tell.
  bool are_two() const { return first_ && second_; }

 private:
  std::optional<SeenBoundary> first_, second_;
  bool is_umbra_ = false, hidden_;
};

}  // namespace penumbra::detail
