#include <penumbra/mesh/shapes.h>
#include <penumbra/render/visibility.h>
#include <penumbra/volumes/volumes.h>

#include <iostream>
#include <vector>

int main() {
  const std::vector<penumbra::TriangleMesh> meshes = {penumbra::make_box({0, 1, 0}, {1, 1, 1})};
  const penumbra::DiskLight light{.center = {0, 6, 0}, .normal = {0, -1, 0}, .radius = 0.5};

  // Geometry: where the box hides the light wholly, and where in part.
  const penumbra::ShadowVolumes shadow = penumbra::build_shadow_volumes(meshes[0], light);
  penumbra::write_shadow_mesh("umbra.ply", shadow.umbra);
  penumbra::write_shadow_mesh("penumbra.ply", shadow.penumbra);

  // Numbers: which fraction of the light points on the ground see.
  const std::vector<penumbra::Vec3> points = {{1.3, 0, 0}, {1.4, 0, 0}, {1.5, 0, 0}};
  const penumbra::MethodResult seen =
      penumbra::visibility(penumbra::Casters(meshes), light, {.points = points});
  for (const float v : seen.visibility) std::cout << v << '\n';
}
