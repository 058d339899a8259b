#include <penumbra/render/scene/scene.h>

#include <fstream>

int main() {
  std::ofstream("corner.obj") << "v 0 1 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\n";
  const penumbra::Scene scene = penumbra::load_scene("corner.obj").scene;
  return scene.objects.size() == 2 && scene.objects[1].mesh.triangles().size() == 1 ? 0 : 1;
}
