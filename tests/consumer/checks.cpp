#include <penumbra/mesh/shapes.h>
#include <penumbra/volumes/checks/checks.h>

int main() {
  const penumbra::TriangleMesh box = penumbra::make_box({0, 1, 0}, {1, 1, 1});
  const penumbra::DiskLight light{.center = {0, 6, 0}, .normal = {0, -1, 0}, .radius = 0.5};
  const penumbra::Classification classes = penumbra::classify_faces(box, light);
  const penumbra::ShadowMesh umbra = penumbra::convex_umbra(box, light, classes);
  return umbra.guarantee == penumbra::Guarantee::kExact && !umbra.triangles.empty() ? 0 : 1;
}
