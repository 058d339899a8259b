#include "render/silhouette/collect/light_band.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>

#include "mesh/vectors.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {
namespace {

/// Before the plane z = depth, where casters end.
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
        in_front_(lit.depth),
        extent_(lit.extent),
        all_in_front_(in_front_(lit.boxes[object].low)) {
    if (!all_in_front_) find_front();
  }

  bool all_in_front() const { return all_in_front_; }

  /// Of casters that are not all in front.
  bool has_end_in_front(EdgeId id) const {
    const Edge& e = mesh_.edges[index(id)];
    return front_[index(e.from)] || front_[index(e.to)];
  }
  bool crosses(FaceId face) const {
    const auto& [a, b, c] = mesh_.triangles[index(face)];
    return front_[a] != front_[b] || front_[b] != front_[c];
  }
  std::size_t face_count() const { return mesh_.triangles.size(); }

  BandEdge edge(EdgeId id) const {
    BandEdge e = mesh_.edge(id, to_frame_, extent_);
    const Vec3 a = e.a, b = e.b;
    if (!in_front_(a)) e.a = in_front_.cut(a, b);
    if (!in_front_(b)) e.b = in_front_.cut(a, b);
    return e;
  }

  /// The front part of a face that crosses the light's plane ends where it leaves the front and begins again
  /// where it comes back.
  BandEdge cut_edge(FaceId face) const {
    const auto corners = mesh_.corners(face, to_frame_);
    BandEdge e{Vec3(0.0), Vec3(0.0), mesh_.plane(face, to_frame_, extent_), kNoFace};
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = corners[k], &q = corners[(k + 1) % 3];
      if (in_front_(p) != in_front_(q)) (in_front_(p) ? e.a : e.b) = in_front_.cut(p, q);
    }
    return e;
  }

 private:
  void find_front() {
    front_.resize(mesh_.positions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, front_.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        front_[i] = in_front_(to_frame_(mesh_.positions[i]));
    });
  }

  MeshArrays mesh_;
  ToFrame to_frame_;
  FrontSide in_front_;
  double extent_;
  bool all_in_front_;
  std::vector<char> front_;  ///< of each vertex, where some are not
};

/// One place per object; none for those that do not cast.
using LitCasters = std::vector<std::optional<LitCaster>>;

struct CutFace {
  std::uint32_t object;
  FaceId face;
};

/// Takes edges that lie behind the plane where casters end out; what is left of faces that cross it is
/// bounded by the faces that are returned. Cost O(faces) of casters that are not wholly in front of it.
std::vector<CutFace> cut_at_light(const LitCasters& casters, std::vector<SceneEdge>& edges) {
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

/// Of the whole scene, receivers included.
double extent_of(const Scene& scene, const Bounds& receivers, const UnitLight& light) {
  Bounds box = scene.bounds();
  box.add(receivers);
  double extent = 1.0;
  for (int corner = 0; corner < 8; ++corner)
    extent = std::max(extent, largest_component(light.point({corner & 1 ? box.high.x : box.low.x,
                                                             corner & 2 ? box.high.y : box.low.y,
                                                             corner & 4 ? box.high.z : box.low.z})));
  return extent;
}

/// By a little more than half a radian: a slope of the golden section, far from those of regular patterns.
LightFrame turned(const LightFrame& axes) {
  constexpr double kCosine = 0.85065080835203993, kSine = 0.52573111211913361;
  return {kCosine * axes.u + kSine * axes.v, kCosine * axes.v - kSine * axes.u, axes.w};
}

}  // namespace

UnitLight::UnitLight(const DiskLight& light)
    : disk_(light),
      axes_(turned(light_frame(light))),
      center_(light.center),
      across_(light.radius * axes_.u),
      up_(light.radius * axes_.v),
      per_radius_(1.0 / light.radius) {}

LitScene::LitScene(const Scene& lit_scene, const UnitLight& unit_light, const SceneEdges& edges,
                   const Bounds& receivers, std::span<const char> flags)
    : scene(lit_scene),
      light(unit_light),
      cannot_occlude(flags),
      depth(kLightOffset / edges.scale() * light.per_radius()),
      boxes(scene.objects.size()),
      extent(extent_of(scene, receivers, light)) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.casts || object.mesh.empty() || (!cannot_occlude.empty() && cannot_occlude[i])) continue;
    boxes[i] = edges.points(i).box_in(light);
    all_in_front = all_in_front && FrontSide(depth)(boxes[i].low);
  }
}

/// A band without edges.
static Band empty_band(const LitScene& lit) {
  Band band;
  band.extent = lit.extent;
  for (std::size_t i = 0; i < lit.boxes.size(); ++i) {
    if (!lit.casts(i)) continue;
    band.casters.push_back(lit.boxes[i]);
    band.faces += lit.scene.objects[i].mesh.triangles().size();
    band.mesh_edges += lit.scene.objects[i].mesh.edges().size();
  }
  return band;
}

Band make_band(const LitScene& lit, const SceneEdges& scene_edges, std::span<const ReceiverRegion> regions) {
  Band band = empty_band(lit);
  LitCasters casters(lit.boxes.size());
  for (std::size_t i = 0; i < casters.size(); ++i)
    if (lit.casts(i)) casters[i].emplace(lit, i);
  std::vector<SceneEdge> edges =
      regions.empty() ? scene_edges.band_of(lit.light.disk(), lit.cannot_occlude)
                      : scene_edges.band_for(regions, lit.scene, lit.light.disk(), lit.cannot_occlude);
  const std::vector<CutFace> cuts = cut_at_light(casters, edges);
  band.cut_edges = cuts.size();
  band.edges = LargeArray<BandEdge>(edges.size() + cuts.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      band.edges[i] = casters[edges[i].object]->edge(edges[i].id);
  });
  for (std::size_t i = 0; i < cuts.size(); ++i)
    band.edges[edges.size() + i] = casters[cuts[i].object]->cut_edge(cuts[i].face);
  return band;
}

Band make_merged_band(const LitScene& lit, const MergedEdges& merged, const MergedLevel& level) {
  struct LightUnits {
    const UnitLight& light;
    Vec3 point(const Vec3& p) const { return light.point(p); }
    Vec3 direction(const Vec3& d) const { return light.direction(d); }
    double per_unit() const { return light.per_radius(); }
  };
  Band band = empty_band(lit);
  const std::vector<std::uint32_t> blocks = merged.blocks_of(level, lit.light.disk(), lit.cannot_occlude);
  band.bounds.resize(blocks.size());
  band.deviation.resize(blocks.size());
  band.lanes = LargeArray<MergedLanes>(blocks.size());
  const std::size_t missing =  // of the level's last block
      !blocks.empty() && blocks.back() + 1 == level.block_count()
          ? level.block_count() * MergedBlock::kEdges - level.edges.size()
          : 0;
  band.edges = LargeArray<BandEdge>(blocks.size() * MergedBlock::kEdges - missing);
  band.sides.resize(band.edges.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size(), 128), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const MergedBlock block = level.block(lit.scene, blocks[i], LightUnits{lit.light}, lit.extent);
      std::copy_n(block.edges.begin(), block.count, band.edges.data() + i * MergedBlock::kEdges);
      std::copy_n(block.sides.begin(), block.count, band.sides.data() + i * MergedBlock::kEdges);
      band.bounds[i] = block.bounds();
      band.lanes[i] = MergedLanes(block, lit.extent);
      band.deviation[i] = static_cast<float>(block.deviation * lit.light.per_radius());
    }
  });
  return band;
}

}  // namespace penumbra::detail
