#include "render/silhouette/collect/light_band.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>

namespace penumbra::detail {
namespace {

// Speed. Items that a task makes: vertices, edges, blocks. Seen in the benchmark `silhouette`, stage band.
constexpr std::size_t kVerticesPerTask = 4096, kEdgesPerTask = 1024, kBlocksPerTask = 128;

/// Tells whether a point of the light's frame is in front of the light's plane (LitScene::depth).
class FrontSide {
 public:
  explicit FrontSide(double depth) : depth_(depth) {}
  bool operator()(const Vec3& p) const { return p.z > depth_; }
  /// Where the segment between a point in front and one behind meets the plane; the same bits for both
  /// directions.
  Vec3 cut(const Vec3& a, const Vec3& b) const {
    const Vec3& front = (*this)(a) ? a : b;
    const Vec3& back = (*this)(a) ? b : a;
    const double t = (front.z - depth_) / (front.z - back.z);
    return {front.x + t * (back.x - front.x), front.y + t * (back.y - front.y), depth_};
  }

 private:
  double depth_;
};

/// Takes positions to the light's frame.
struct ToFrame {
  const UnitLight& light;
  Vec3 operator()(const Vec3& p) const { return light.point(p); }
};

/// A caster under the light. Vertices are taken to the light's frame where they are needed, with the same
/// bits each time.
class LitCaster {
 public:
  LitCaster(const LitScene& lit, std::size_t object)
      : mesh_(lit.scene.objects[object].mesh),
        to_frame_{lit.light},
        is_in_front_(lit.depth),
        extent_(lit.extent),
        all_in_front_(is_in_front_(lit.boxes[object].low)) {
    if (!all_in_front_) find_front();
  }

  bool all_in_front() const { return all_in_front_; }

  // The next three are for casters that are not all in front.
  bool has_end_in_front(EdgeId id) const {
    const Edge& e = mesh_.edges[index(id)];
    return front_[index(e.from)] || front_[index(e.to)];
  }
  bool crosses(FaceId face) const {
    const auto& [a, b, c] = mesh_.triangles[index(face)];
    return front_[a] != front_[b] || front_[b] != front_[c];
  }
  std::size_t face_count() const { return mesh_.triangles.size(); }

  /// The part of an edge in front of the plane; requires an end in front.
  BandEdge edge(EdgeId id) const {
    BandEdge e = mesh_.edge(id, to_frame_, extent_);
    const Vec3 a = e.a, b = e.b;
    if (!is_in_front_(a)) e.a = is_in_front_.cut(a, b);
    if (!is_in_front_(b)) e.b = is_in_front_.cut(a, b);
    return e;
  }

  /// The cut of a face that crosses the plane: from where its outline leaves the front to where it comes
  /// back.
  BandEdge cut_edge(FaceId face) const {
    const auto corners = mesh_.corners(face, to_frame_);
    BandEdge e{Vec3(0.0), Vec3(0.0), mesh_.plane(face, to_frame_, extent_), kNoFace};
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = corners[k], &q = corners[(k + 1) % 3];
      if (is_in_front_(p) != is_in_front_(q)) (is_in_front_(p) ? e.a : e.b) = is_in_front_.cut(p, q);
    }
    return e;
  }

 private:
  void find_front() {
    front_.resize(mesh_.positions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, front_.size(), kVerticesPerTask),
                      [&](const auto& range) {
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                          front_[i] = is_in_front_(to_frame_(mesh_.positions[i]));
                      });
  }

  MeshArrays mesh_;
  ToFrame to_frame_;
  FrontSide is_in_front_;
  double extent_;
  bool all_in_front_;
  /// For each vertex whether it is in front; empty where all are.
  std::vector<char> front_;
};

/// One an object; none for objects that do not cast.
using LitCasters = std::vector<std::optional<LitCaster>>;

/// A face that crosses the light's plane.
struct CutFace {
  std::uint32_t object;
  FaceId face;
};

/// Removes edges that lie behind the light's plane, and returns the faces that cross it. Cost
/// O(faces) of casters that are not wholly in front of it.
std::vector<CutFace> drop_behind(const LitCasters& casters, std::vector<SceneEdge>& edges) {
  const auto is_cut = [](const auto& c) { return c && !c->all_in_front(); };
  std::vector<CutFace> cuts;
  if (std::ranges::none_of(casters, is_cut)) return cuts;
  std::erase_if(edges, [&](const SceneEdge& e) {
    const LitCaster& caster = *casters[e.object];
    return !caster.all_in_front() && !caster.has_end_in_front(e.id);
  });
  for (std::uint32_t object = 0; object < casters.size(); ++object) {
    if (!is_cut(casters[object])) continue;
    for (std::uint32_t face = 0; face < casters[object]->face_count(); ++face)
      if (casters[object]->crosses(FaceId{face})) cuts.push_back({object, FaceId{face}});
  }
  return cuts;
}

/// A band without edges.
Band empty_band(const LitScene& lit) {
  Band band;
  band.extent = lit.extent;
  if (lit.depth > 0.0) band.depth = lit.depth / lit.light.per_radius();
  for (std::size_t i = 0; i < lit.boxes.size(); ++i) {
    if (!lit.casts(i)) continue;
    band.casters.push_back(lit.boxes[i]);
    band.faces += lit.scene.objects[i].mesh.triangles().size();
    band.mesh_edges += lit.scene.objects[i].mesh.edges().size();
  }
  return band;
}

}  // namespace

Band make_band(const LitScene& lit, const SceneEdges& scene_edges, std::span<const ReceiverRegion> regions) {
  Band band = empty_band(lit);
  LitCasters casters(lit.boxes.size());
  for (std::size_t i = 0; i < casters.size(); ++i)
    if (lit.casts(i)) casters[i].emplace(lit, i);

  // Which edges, and which cuts of faces.
  std::vector<SceneEdge> edges =
      regions.empty() ? scene_edges.band_of(lit.light.light(), lit.cannot_occlude)
                      : scene_edges.band_for(regions, lit.scene, lit.light.light(), lit.cannot_occlude);
  const std::vector<CutFace> cuts = drop_behind(casters, edges);
  band.cut_edges = cuts.size();

  // All of them in the light's frame.
  band.edges = LargeArray<BandEdge>(edges.size() + cuts.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges.size(), kEdgesPerTask), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      band.edges[i] = casters[edges[i].object]->edge(edges[i].id);
  });
  for (std::size_t i = 0; i < cuts.size(); ++i)
    band.edges[edges.size() + i] = casters[cuts[i].object]->cut_edge(cuts[i].face);
  return band;
}

Band make_merged_band(const LitScene& lit, const MergedEdges& merged, const MergedLevel& level) {
  /// The light's frame, as MergedLevel::block takes it.
  struct LightUnits {
    const UnitLight& light;
    Vec3 point(const Vec3& p) const { return light.point(p); }
    Vec3 direction(const Vec3& d) const { return light.direction(d); }
    double per_unit() const { return light.per_radius(); }
  };
  Band band = empty_band(lit);
  const std::vector<std::uint32_t> blocks = merged.blocks_of(level, lit.light.light(), lit.cannot_occlude);
  const MergedLevel::EdgeCounts counts = level.count_edges(blocks);
  band.bounds.resize(blocks.size());
  band.lanes = LargeArray<MergedLanes>(blocks.size());
  // Only the level's last block may have fewer than eight edges.
  const std::size_t missing = !blocks.empty() && blocks.back() + 1 == level.block_count()
                                  ? level.block_count() * MergedBlock::kEdges - level.edges.size()
                                  : 0;
  band.edges = LargeArray<BandEdge>(blocks.size() * MergedBlock::kEdges - missing);
  band.sides.resize(band.edges.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, blocks.size(), kBlocksPerTask), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const MergedBlock block =
              level.block(lit.scene, blocks[i], LightUnits{lit.light}, lit.extent, counts);
          std::copy_n(block.edges.begin(), block.count, band.edges.data() + i * MergedBlock::kEdges);
          std::copy_n(block.sides.begin(), block.count, band.sides.data() + i * MergedBlock::kEdges);
          band.bounds[i] = block.bounds();
          band.lanes[i] = MergedLanes(block, lit.extent);
        }
      });
  return band;
}

}  // namespace penumbra::detail
