#include "apps/viewer/pictures/overlay_geometry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>

#include "apps/common/scene_volumes.h"
#include "apps/viewer/pictures/overlay_colors.h"
#include "penumbra/volumes/volumes.h"

namespace penumbra::viewer {
namespace {

using Color = OverlayColor;

Color face_color(FaceClass face) {
  if (face == FaceClass::kMixed) return kMixedColor;
  return face == FaceClass::kAllFront ? kAllFrontColor : kNoneFrontColor;
}

Color sheet_color(ShadowKind kind) {
  switch (kind) {
    case ShadowKind::kPenumbraCone:
      return kPenumbraConeColor;
    case ShadowKind::kUmbraFacet:
      return kUmbraFacetColor;
    case ShadowKind::kUmbraCap:
      return kUmbraCapColor;
    default:
      return kPenumbraFacetColor;
  }
}

// Many cells lie behind one another: each is then fainter.
Color cell_color(const ShadowMesh& volume, Color color) {
  const double share = 110.0 / std::sqrt(std::max<double>(1.0, static_cast<double>(volume.cells)));
  color.a = static_cast<unsigned char>(std::clamp(share, 5.0, 70.0));
  return color;
}

class Builder {
 public:
  Builder(const Scene& scene, const CircularLight& light, const Overlays& wanted)
      : scene_(scene), light_(light), wanted_(wanted), bound_(apps::extrude_options_for(scene, light)) {
    out_.origin = bound_.bound_center;
    out_.bound = bound_.bound_radius;
    set_way();
  }

  OverlayGeometry build() {
    VolumeOptions options{
        .sheets = wanted_.sheets, .penumbra = wanted_.penumbra, .umbra = wanted_.umbra, .extrude = bound_};
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      const SceneObject& object = scene_.objects[i];
      for (const IndexedTriangle& t : object.mesh.triangles())
        triangle(out_.scene, object.mesh.positions(), t, {});
      if (!object.casts) continue;
      options.extrude.object = static_cast<std::uint32_t>(i);
      add_caster(object.mesh, options);
    }
    return std::move(out_);
  }

 private:
  void set_way() {
    const Vec3 normal = light_frame(light_).w;
    double low = INFINITY, high = -INFINITY;
    for (const SceneObject& object : scene_.objects)
      for (const Vec3& p : object.mesh.positions()) {
        const double along = glm::dot(p - out_.origin, normal);
        low = std::min(low, along);
        high = std::max(high, along);
      }
    const double plane = glm::dot(way_to_center(light_, out_.origin), normal);
    if (!light_.is_distant() && std::abs(plane) < out_.bound) low = plane;
    out_.start = out_.origin + low * normal;
    out_.reach = std::max(0.0, high - low);
  }
  OverlayVertex vertex(const Vec3& p, Color c) const {
    const Vec3 q = p - out_.origin;
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), {c.r, c.g, c.b, c.a}};
  }
  void triangle(std::vector<OverlayVertex>& list, std::span<const Vec3> positions, const IndexedTriangle& t,
                Color color) const {
    for (const std::uint32_t corner : t) list.push_back(vertex(positions[corner], color));
  }
  void lines(const TriangleMesh& mesh, const std::vector<EdgeId>& edges, Color color) {
    for (const EdgeId id : edges) {
      const Edge& edge = mesh.edges()[index(id)];
      out_.lines.push_back(vertex(mesh.position(edge.from), color));
      out_.lines.push_back(vertex(mesh.position(edge.to), color));
    }
  }
  void volume(const ShadowMesh& mesh, Color color) {
    for (const IndexedTriangle& t : mesh.triangles)
      triangle(out_.sheets, mesh.positions, t, cell_color(mesh, color));
  }

  void add_caster(const TriangleMesh& mesh, const VolumeOptions& options) {
    const ShadowVolumes made = build_shadow_volumes(mesh, light_, options);
    const std::vector<FaceClass>& classes = made.classes.faces;
    if (wanted_.faces)
      for (std::size_t f = 0; f < classes.size(); ++f)
        triangle(out_.faces, mesh.positions(), mesh.triangles()[f], face_color(classes[f]));
    if (wanted_.band) lines(mesh, made.silhouettes.band, kBandColor);
    if (wanted_.silhouettes) {
      lines(mesh, made.silhouettes.penumbra, kPenumbraColor);
      lines(mesh, made.silhouettes.umbra, kUmbraColor);
    }
    for (std::size_t t = 0; t < made.sheets.triangles.size(); ++t)
      triangle(out_.sheets, made.sheets.positions, made.sheets.triangles[t],
               sheet_color(made.sheets.tags[t].kind));
    volume(made.penumbra, kPenumbraColor);
    volume(made.umbra, kUmbraColor);
  }

  const Scene& scene_;
  const CircularLight& light_;
  const Overlays& wanted_;
  const ExtrudeOptions bound_;
  OverlayGeometry out_;
};

bool same_lists(const Overlays& a, const Overlays& b) {
  return a.faces == b.faces && a.silhouettes == b.silhouettes && a.band == b.band && a.sheets == b.sheets &&
         a.penumbra == b.penumbra && a.umbra == b.umbra;
}

}  // namespace

OverlayGeometry make_overlay_geometry(const Scene& scene, const CircularLight& light,
                                      const Overlays& wanted) {
  return Builder(scene, light, wanted).build();
}

OverlayMaker::~OverlayMaker() {
  if (task_.valid()) task_.wait();
}

bool OverlayMaker::fits(const State& state) const {
  return state.model == made_for_.model && state.lights == made_for_.lights &&
         state.selected == made_for_.selected && same_lists(state.overlays, made_for_.overlays);
}

std::shared_ptr<const OverlayGeometry> OverlayMaker::update(const State& state) {
  if (task_.valid() && task_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    try {
      ready_ = task_.get();
    } catch (const std::exception&) {  // no memory, say: there is nothing to draw of this state
      ready_ = nullptr;
    }
  }
  if (!state.overlays.geometry()) return nullptr;
  if (!task_.valid() && !fits(state)) {
    made_for_ = state;
    task_ = std::async(std::launch::async, [scene = current_scene(state), light = state.circular(),
                                            wanted = state.overlays, wake = wake_] {
      auto made = std::make_shared<const OverlayGeometry>(make_overlay_geometry(scene, light, wanted));
      wake();
      return made;
    });
  }
  return ready_;
}

}  // namespace penumbra::viewer
