// Solids: edges of a surface collapse in one of several disjoint boxes.
//
// A vertex is free if all triangles around it lie wholly in the box. Edges between free vertices collapse,
// and the new vertex stays in the box. So triangles of other boxes, which change at the same time, are never
// met or looked at; those that reach beyond one box do not change.
#pragma once

#include <queue>
#include <tuple>

#include "volumes/solids/simplify/collapse_planner.h"
#include "volumes/solids/simplify/disjoint_boxes.h"
#include "volumes/solids/simplify/face_boxes.h"

namespace penumbra::detail {

/// What all boxes share.
struct BoxedSurface {
  ChangingSurface& surface;
  const DisjointBoxes& boxes;
  std::vector<std::uint32_t> box_of;    ///< vertices
  std::vector<std::uint32_t> crossing;  ///< triangles that reach beyond a box
  std::vector<std::uint32_t> place;     ///< of triangles among those of their box
};

BoxedSurface boxed(ChangingSurface& surface, const DisjointBoxes& boxes);

class BoxCollapses {
 public:
  BoxCollapses(BoxedSurface& all, std::uint32_t box);

  /// How many edges have collapsed. Least change first. Does not change what other boxes read or change.
  std::size_t run();

 private:
  /// An edge at the time when its cost was found. Later costs are hardly ever less, so that an old cost will
  /// do to wait by.
  struct Candidate {
    double cost;
    std::uint32_t a, b;
    std::uint32_t version_a, version_b;
    bool operator<(const Candidate& other) const {
      return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b);  // least on top
    }
  };
  /// A triangle around an edge as it would become.
  struct Moved {
    IndexedTriangle named;
    std::array<Vec3, 3> corners;
    Bounds box;
  };

  bool is_inside(const IndexedTriangle& t) const;
  bool is_free(std::uint32_t v) const;
  std::uint32_t current(std::uint32_t v);
  void push(std::uint32_t a, std::uint32_t b, double cost);
  void look_at(const Candidate& c);
  bool is_allowed(std::uint32_t a, std::uint32_t b, const Vec3& point);
  bool joins_two_triangles_only(std::uint32_t a, std::uint32_t b);
  bool find_moved(std::uint32_t a, std::uint32_t b, const Vec3& point);
  bool meets_others(std::uint32_t a, std::uint32_t b) const;
  void collapse(std::uint32_t a, std::uint32_t b, const CollapsePlan& plan);

  BoxedSurface& all_;
  ChangingSurface& surface_;
  std::uint32_t box_;
  CollapsePlanner planner_;
  std::vector<std::uint32_t> faces_;  ///< in the box, then those that reach into it
  std::size_t inside_ = 0;
  FaceBoxes face_boxes_;
  std::priority_queue<Candidate> queue_;
  std::size_t collapsed_ = 0;
  std::vector<std::uint32_t> neighbors_, others_;
  std::vector<Moved> moved_;
};

}  // namespace penumbra::detail
