#include "render/rays/ray_groups.h"

#include <algorithm>
#include <optional>

namespace penumbra::detail {
namespace {

constexpr std::size_t kMostGroups = 8;
/// A group may be so many times the size of its smallest part, which then keeps 16 bits: float moves its
/// points by less than 1e-5 of its size.
constexpr double kMostScales = 256.0;

double extent(const Bounds& bounds) {
  const Vec3 size = bounds.high - bounds.low;
  return std::max({size.x, size.y, size.z});
}

Bounds joint(Bounds a, const Bounds& b) {
  a.add(b);
  return a;
}

/// An object, or one component of it.
struct Piece {
  std::uint32_t object;
  const Component* component;  ///< null: all of the object
  Bounds bounds;
};

Bounds bounds_of(const Component& component, const TriangleMesh& mesh) {
  Bounds out;
  for (const FaceId f : component.faces)
    for (const std::uint32_t v : mesh.triangles()[index(f)]) out.add(mesh.positions()[v]);
  return out;
}

/// The components where they are of very different sizes or far apart, else the whole.
void add_pieces(const TriangleMesh& mesh, std::uint32_t object, std::vector<Piece>& out) {
  const std::size_t first = out.size();
  double least = extent(mesh.bounds());
  if (mesh.components().size() > 1)
    for (const Component& c : mesh.components()) {
      out.push_back({object, &c, bounds_of(c, mesh)});
      least = std::min(least, extent(out.back().bounds));
    }
  if (extent(mesh.bounds()) <= kMostScales * least) {
    out.resize(first, Piece{});
    out.push_back({object, nullptr, mesh.bounds()});
  }
}

/// Pieces by ascending size, each into the group that grows least by it. None where more than the most groups
/// would be needed.
std::optional<std::vector<std::vector<const Piece*>>> try_to_group(const std::vector<Piece>& pieces,
                                                                   double most_scales) {
  struct Group {
    Bounds bounds;
    double largest;  ///< that it may become
    std::vector<const Piece*> pieces;
  };
  std::vector<Group> groups;
  for (const Piece& piece : pieces) {
    Group* best = nullptr;
    double best_extent = 0.0;
    for (Group& g : groups) {
      const double size = extent(joint(g.bounds, piece.bounds));
      if (size > g.largest || (best && size >= best_extent)) continue;
      best = &g;
      best_extent = size;
    }
    if (!best) {
      if (groups.size() == kMostGroups) return std::nullopt;
      best = &groups.emplace_back(Group{{}, most_scales * extent(piece.bounds), {}});
    }
    best->bounds.add(piece.bounds);
    best->pieces.push_back(&piece);
  }
  std::vector<std::vector<const Piece*>> out;
  for (Group& g : groups) out.push_back(std::move(g.pieces));
  return out;
}

/// Pieces of one object become one part.
RayPartGroup joined(std::vector<const Piece*> pieces, const Scene& scene) {
  std::ranges::stable_sort(pieces, {}, &Piece::object);
  RayPartGroup out;
  for (const Piece* piece : pieces) {
    out.bounds.add(piece->bounds);
    if (out.parts.empty() || out.parts.back().object != piece->object)
      out.parts.push_back({piece->object, {}});
    if (!piece->component) continue;
    std::vector<std::uint32_t>& faces = out.parts.back().faces;
    for (const FaceId f : piece->component->faces) faces.push_back(static_cast<std::uint32_t>(f));
  }
  for (RayPart& part : out.parts) {
    if (part.faces.size() == scene.objects[part.object].mesh.triangles().size()) part.faces.clear();
    std::ranges::sort(part.faces);
  }
  return out;
}

}  // namespace

std::vector<RayPartGroup> group_by_scale(const Scene& scene, bool casts) {
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (object.casts != casts || object.mesh.empty()) continue;
    add_pieces(object.mesh, i, pieces);
  }
  if (pieces.empty()) return {};
  std::ranges::stable_sort(pieces, {}, [](const Piece& p) { return extent(p.bounds); });
  std::vector<RayPartGroup> out;
  for (double scales = kMostScales; out.empty(); scales *= 2.0)
    if (const auto groups = try_to_group(pieces, scales))
      for (const auto& group : *groups) out.push_back(joined(group, scene));
  return out;
}

}  // namespace penumbra::detail
