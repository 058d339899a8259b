#include <penumbra/render/renderer.h>

#include <fstream>

int main() {
  std::ofstream("corner.obj") << "v 0 1 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\n";
  const penumbra::Scene scene = penumbra::load_scene("corner.obj").scene;
  penumbra::RenderOptions options;
  options.method = penumbra::Method::kHard;
  options.width = options.height = 16;
  return penumbra::render(scene, options).image.width == 16 ? 0 : 1;
}
