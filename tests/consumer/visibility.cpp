#include <penumbra/mesh/shapes.h>
#include <penumbra/render/visibility.h>

#include <vector>

int main() {
  const std::vector<penumbra::TriangleMesh> meshes = {penumbra::make_box({0, 1, 0}, {1, 1, 1})};
  const penumbra::DiskLight light{.center = {0, 6, 0}, .normal = {0, -1, 0}, .radius = 0.5};
  const std::vector<penumbra::Vec3> points = {{0, -1, 0}, {9, -1, 0}};
  const std::vector<float> v =
      penumbra::visibility(penumbra::Casters(meshes), light, {.points = points}).visibility;
  return v.size() == 2 && v[0] == 0.0f && v[1] == 1.0f ? 0 : 1;
}
