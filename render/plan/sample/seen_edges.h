// Planner, step measure: a sample of the casters' edges and faces, and how many of all lie before a light.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "penumbra/render/plan/plan.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// Numbers of edges column by column, for loops over many of them. Single precision, relative to a point
/// among them.
struct EdgeColumns {
  /// Ends: u, v, depth. Planes of faces: normal and offset.
  std::array<std::vector<float>, 3> from, to;
  std::array<std::vector<float>, 4> left, right;
};

/// Boxes column by column.
struct BoxColumns {
  std::array<std::vector<double>, 3> low, high;
};

/// Some of the edges of the casters that may reach receivers.
class EdgeSample {
 public:
  /// Evenly chosen: every so manieth edge. Cost O(casters + count).
  EdgeSample(const Scene& objects, const CircularLight& light, std::span<const CasterFacts> casters,
             std::size_t count);

  /// How many edges lie across the light as x sees it and are silhouettes from there: boundary edges, and
  /// those with one face towards x and one away.
  struct Crossing {
    double edges = 0.0;
    /// Edges between two faces of fine casters count by their length over a tenth of the light's radius, at
    /// most 1: short ones are merged (silhouette-tolerance).
    double merged = 0.0;
    /// The sum of their lengths, light radii, at most two each.
    double length = 0.0;
  };
  /// An estimate. Cost O(count).
  Crossing crossing(const Vec3& x) const;
  /// How many edges each of the sample stands for: fewer than that are not told from none.
  double each_stands_for() const { return each_stands_for_; }
  /// How many edges are in the band: all but those whose faces both face all of the light, or both none of
  /// it. An estimate.
  double band() const { return each_stands_for_ * static_cast<double>(band_); }

 private:
  /// An edge in the light's frame: u, v, depth.
  struct Seen {
    Vec3 from{0.0}, to{0.0};
    /// Planes of the faces, normal·p + offset; of a boundary edge two that have every point on different
    /// sides.
    std::array<Vec3, 2> normals{Vec3(0.0), Vec3(0.0)};
    std::array<double, 2> offsets{1.0, -1.0};
    bool is_boundary = true, may_merge = false;
  };
  Seen seen(const TriangleMesh& mesh, const Edge& edge) const;
  Vec3 in_frame(const Vec3& world) const;
  /// How long the edge is across the light, in radii, as x sees it; 0 where it is not.
  double length_across(const Seen& edge, const Vec3& x) const;
  bool is_in_band(const Seen& edge) const;
  void fill_columns();
  void add(const Seen& edge, const Vec3& x, Crossing& out) const;

  /// Edges that come one after another, of one place mostly: most of such groups lie beside the light as a
  /// whole.
  static constexpr std::size_t kGroup = 32;

  CircularLight light_;
  LightFrame axes_;
  std::vector<Seen> edges_;
  std::vector<Bounds> groups_;
  Vec3 origin_{0.0};
  EdgeColumns columns_;
  std::size_t band_ = 0;
  double each_stands_for_ = 1.0;
};

/// Some of the faces' boxes.
class FaceSample {
 public:
  FaceSample(const Scene& objects, std::span<const CasterFacts> casters, std::size_t count);
  /// An estimate of how many boxes of faces the segment from x along `way` meets; `endless`: the ray. Cost
  /// O(count).
  double boxes_on(const Vec3& x, const Vec3& way, bool endless) const;

 private:
  BoxColumns boxes_;
  double each_stands_for_ = 1.0;
};

}  // namespace penumbra::detail
