// libFuzzer target for the mesh readers and the builder: any bytes give a mesh or a MeshError, nothing else.
//
// The first byte picks the file name that serves as a hint.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::array<std::string, 5> kNames = {"fuzz.ply", "fuzz.obj", "fuzz.off", "fuzz.stl", "fuzz"};
  if (size == 0) {
    return 0;
  }
  const std::span bytes(reinterpret_cast<const std::byte*>(data) + 1, size - 1);
  try {
    const penumbra::PolygonSoup soup = penumbra::parse_polygon_soup(bytes, kNames[data[0] % kNames.size()]);
    const penumbra::Triangulation faces = penumbra::triangulate(soup);
    const auto mesh = penumbra::TriangleMesh::build(soup.positions, faces.triangles);
    if (mesh.triangles().size() + mesh.report().degenerate.size() != faces.triangles.size()) {
      std::abort();
    }
  } catch (const penumbra::MeshError&) {
  }
  return 0;
}
