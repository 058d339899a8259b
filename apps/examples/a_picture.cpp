// A picture of a scene under two lights: a_picture SCENE
#include <penumbra/render/image/image.h>
#include <penumbra/render/renderer.h>

#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 2) return std::cerr << "usage: a_picture SCENE\n", 2;
  penumbra::Scene scene = penumbra::load_scene(argv[1]).scene;
  const penumbra::Vec3 middle = scene.caster_bounds().center();
  const double size = scene.caster_bounds().radius();
  const penumbra::Vec3 lamp = middle + size * penumbra::Vec3(3, 2, 3);
  scene.lights.front().name = "key";
  scene.lights.push_back(
      {.name = "fill",
       .shape = penumbra::DiskLight{.center = lamp, .normal = middle - lamp, .radius = 0.3 * size},
       .radiance = {2, 3, 6}});

  penumbra::RenderOptions options{.method = "silhouette", .width = 480, .height = 360};
  options.options["silhouette-tolerance"] = 0.0;  // no faces are merged
  const penumbra::RenderResult result = penumbra::render(scene, options);
  std::cout << result.method << ": " << result.frame_ms << " ms\n";
  penumbra::write_png("picture.png", result.image, 1.0);
  penumbra::write_exr("picture.exr", result.image);  // with channels visibility.key and visibility.fill
} catch (const penumbra::Error& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
