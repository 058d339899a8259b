#include <penumbra/mesh/error.h>
#include <penumbra/mesh/shapes.h>
#include <penumbra/render/solids/light_field.h>
#include <penumbra/render/visibility.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

/// Whether OpenVDB is in this process.
bool has_openvdb() {
  std::ifstream maps("/proc/self/maps");
  const std::string text{std::istreambuf_iterator<char>(maps), {}};
  return text.find("libopenvdb") != std::string::npos;
}

/// Whether a field is written as .vdb. Where the library was built without OpenVDB, whether it says what to
/// install.
bool writes_vdb(const penumbra::LightField& field, bool built_with_openvdb) {
  try {
    penumbra::write_light_field("seen.vdb", field);
    return built_with_openvdb && has_openvdb() && std::filesystem::file_size("seen.vdb") > 100;
  } catch (const penumbra::SystemError& e) {
    return !built_with_openvdb && std::string(e.what()).find("libopenvdb-dev") != std::string::npos;
  }
}

/// An argument says that the library was built with OpenVDB.
int main(int argc, char**) {
  const std::vector<penumbra::TriangleMesh> meshes = {penumbra::make_box({0, 1, 0}, {1, 1, 1})};
  const penumbra::DiskLight light{.center = {0, 6, 0}, .normal = {0, -1, 0}, .radius = 0.5};
  const std::vector<penumbra::Vec3> points = {{0, -1, 0}, {9, -1, 0}};
  const penumbra::Casters casters(meshes);
  const std::vector<float> v = penumbra::visibility(casters, light, {.points = points}).visibility;
  if (v.size() != 2 || v[0] != 0.0f || v[1] != 1.0f) return 1;

  const penumbra::LightField field =
      penumbra::light_field(casters, light, {{-2, -1, -2}, {2, 2, 2}}, {8, 8, 8});
  penumbra::write_light_field("seen.npy", field);
  if (has_openvdb()) return 2;
  return writes_vdb(field, argc > 1) ? 0 : 3;
}
