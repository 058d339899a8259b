#include <penumbra/mesh/shapes.h>

int main() {
  const penumbra::TriangleMesh box = penumbra::make_box({0, 1, 0}, {1, 1, 1});
  return box.triangles().size() == 12 && box.positions().size() == 8 ? 0 : 1;
}
