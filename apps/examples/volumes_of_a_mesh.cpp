// Umbra and penumbra volumes of a mesh below a disk light: volumes_of_a_mesh MESH
#include <penumbra/mesh/io/polygon_soup.h>
#include <penumbra/volumes/volumes.h>

#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 2) return std::cerr << "usage: volumes_of_a_mesh MESH\n", 2;
  const penumbra::TriangleMesh mesh = penumbra::read_mesh(argv[1]);
  const double size = mesh.bounds().radius();
  const penumbra::DiskLight light{.center = mesh.bounds().center() + penumbra::Vec3(0, 5 * size, 0),
                                  .normal = {0, -1, 0},
                                  .radius = 0.5 * size};

  const penumbra::ShadowVolumes shadow = penumbra::build_shadow_volumes(mesh, light);
  std::cout << shadow.classes.all_front << " faces look at the whole light, "
            << shadow.silhouettes.band.size() << " edges may bound its shadow\n"
            << "umbra: " << shadow.umbra.triangles.size() << " triangles, guarantee "
            << name_of(shadow.umbra.guarantee) << "\npenumbra: " << shadow.penumbra.triangles.size()
            << " triangles, guarantee " << name_of(shadow.penumbra.guarantee) << '\n';
  penumbra::write_shadow_mesh("umbra.ply", shadow.umbra);
  penumbra::write_shadow_mesh("penumbra.ply", shadow.penumbra);
} catch (const penumbra::Error& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
