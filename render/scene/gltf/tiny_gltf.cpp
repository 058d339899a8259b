#define TINYGLTF_IMPLEMENTATION
#include <nlohmann/json.hpp>
// The JSON comes before the library that is made of it.
#include "render/scene/gltf/tiny_gltf.h"
