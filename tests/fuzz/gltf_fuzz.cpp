// libFuzzer target for glTF: any bytes give a scene, a SceneError or a MeshError, nothing else. Buffers in
// other files are not found.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "penumbra/mesh/error.h"
#include "render/scene/gltf/gltf_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const penumbra::LoadedScene loaded =
        penumbra::detail::read_gltf(std::as_bytes(std::span(data, size)), "/nowhere", "f.gltf", {});
    if (loaded.scene.lights.empty() || loaded.scene.objects.empty()) std::abort();
  } catch (const penumbra::SceneError&) {
  } catch (const penumbra::MeshError&) {
  }
  return 0;
}
