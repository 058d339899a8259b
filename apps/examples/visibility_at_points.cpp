// The soft shadow of a mesh on the plane below it, as text: visibility_at_points MESH
#include <penumbra/mesh/io/polygon_soup.h>
#include <penumbra/render/visibility.h>

#include <cmath>
#include <iostream>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 2) return std::cerr << "usage: visibility_at_points MESH\n", 2;
  const std::vector<penumbra::TriangleMesh> meshes = {penumbra::read_mesh(argv[1])};
  const penumbra::Bounds& box = meshes.front().bounds();
  const double size = box.radius();
  const penumbra::DiskLight light{
      .center = box.center() + penumbra::Vec3(0, 4 * size, 0), .normal = {0, -1, 0}, .radius = 0.5 * size};
  constexpr int kColumns = 60, kRows = 30;
  std::vector<penumbra::Vec3> points;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      points.push_back({box.center().x + size * (4.0 * column / (kColumns - 1) - 2.0), box.low.y - size,
                        box.center().z + size * (4.0 * row / (kRows - 1) - 2.0)});

  const penumbra::Casters casters(meshes);
  const std::vector<float> v = penumbra::visibility(casters, light, {.points = points}).visibility;
  for (std::size_t i = 0; i < v.size(); ++i)
    std::cout << "@%#*+=-:. "[std::lround(9 * v[i])] << ((i + 1) % kColumns == 0 ? "\n" : "");
} catch (const penumbra::Error& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
