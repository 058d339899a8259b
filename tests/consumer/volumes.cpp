#include <penumbra/mesh/shapes.h>
#include <penumbra/volumes/volumes.h>
#include <iostream>

int main() {
  const penumbra::TriangleMesh box = penumbra::make_box({0, 1, 0}, {1, 1, 1});
  const penumbra::DiskLight light{.center = {0, 6, 0}, .normal = {0, -1, 0}, .radius = 0.5};
  const penumbra::ShadowVolumes shadow = penumbra::build_shadow_volumes(box, light);
  std::cout << shadow.classes.all_front << " faces look at the whole light, "
            << shadow.silhouettes.band.size() << " edges may bound its shadow; the penumbra has "
            << shadow.penumbra.triangles.size() << " triangles\n";
  penumbra::write_shadow_mesh("penumbra.ply", shadow.penumbra);
  const penumbra::DistantLight sun{.direction = {0, -1, 0}, .angle_degrees = 0.53};
  return penumbra::build_shadow_volumes(box, sun).umbra.guarantee == penumbra::Guarantee::kExact ? 0 : 1;
}
