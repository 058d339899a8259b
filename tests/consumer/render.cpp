#include <penumbra/mesh/shapes.h>
#include <penumbra/render/renderer.h>

int main() {
  penumbra::Scene scene;
  scene.lights.push_back(
      {.shape = penumbra::DiskLight{.center = {0, 6, 0}, .normal = {0, -1, 0}, .radius = 0.5}});
  scene.objects.push_back({.name = "box", .mesh = penumbra::make_box({0, 1, 0}, {1, 1, 1})});
  const penumbra::RenderOptions options{.method = "dbuffer", .width = 16, .height = 16};
  return penumbra::render(scene, options).image.width == 16 ? 0 : 1;
}
