// libFuzzer target for scene files: any bytes give a scene, a SceneError or a MeshError, nothing else.
//
// Bytes become the file scene.json in a folder of the process's own, beside the mesh t.off that scenes may
// name.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"
#include "render/light/area_light.h"

namespace {

/// The folder, made once. Meshes elsewhere can be named too, as in any scene file.
const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const auto made = std::filesystem::temp_directory_path() / ("penumbra-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    std::ofstream(made / "t.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n";
    std::atexit([] { std::filesystem::remove_all(folder()); });
    return made;
  }();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = folder() / "scene.json";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const penumbra::LoadedScene loaded = penumbra::load_scene(file);
    if (loaded.scene.lights.empty()) std::abort();
    for (const penumbra::Light& light : loaded.scene.lights) {
      const penumbra::AreaLight area = penumbra::area_light(light.shape);
      if (!(area.half.x >= 0.0 && area.half.y >= 0.0 && light.radiance.x >= 0.0)) std::abort();
    }
  } catch (const penumbra::SceneError&) {
  } catch (const penumbra::MeshError&) {
  }
  return 0;
}
