#include "render/silhouette/caster_boxes.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace penumbra::detail {
namespace {

// Speed. More boxes fit closer and cost more for each group of receivers that they do not clear.
constexpr std::size_t kMostBoxes = 64, kFewFaces = 8;

/// Faces by the middle of their boxes, halved across the longest side of all middles, over and over.
class Halving {
 public:
  Halving(const TriangleMesh& mesh, std::vector<Bounds>& out)
      : faces_(mesh.triangles().size()), most_(std::max(kFewFaces, faces_.size() / kMostBoxes)), out_(out) {
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (const std::uint32_t corner : mesh.triangles()[i]) faces_[i].add(mesh.positions()[corner]);
    if (!faces_.empty()) halve(faces_);
  }

 private:
  void halve(std::span<Bounds> faces) {
    if (faces.size() <= most_) {
      Bounds box;
      for (const Bounds& face : faces) box.add(face);
      out_.push_back(box);
      return;
    }
    Bounds middles;
    for (const Bounds& face : faces) middles.add(face.center());
    const Vec3 size = middles.high - middles.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::size_t middle = faces.size() / 2;
    std::nth_element(
        faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(middle), faces.end(),
        [axis](const Bounds& a, const Bounds& b) { return a.center()[axis] < b.center()[axis]; });
    halve(faces.first(middle));
    halve(faces.subspan(middle));
  }

  std::vector<Bounds> faces_;
  std::size_t most_;
  std::vector<Bounds>& out_;
};

}  // namespace

CasterBoxes::CasterBoxes(const Scene& scene) : boxes_(scene.objects.size()) {
  tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t i) {
    if (scene.objects[i].casts) Halving(scene.objects[i].mesh, boxes_[i]);
  });
}

}  // namespace penumbra::detail
