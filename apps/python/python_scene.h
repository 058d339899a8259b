// The class Scene of the Python module: objects, lights and a camera, with casters that are made when they
// are asked for.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/python/arrays.h"
#include "penumbra/render/visibility.h"

namespace penumbra::python {

/// To be used with Python's lock. What a call needs without it, it copies or shares.
class PythonScene {
 public:
  explicit PythonScene(int threads) : threads_(threads) {}
  /// Throws FileNotFoundError beside what load_scene throws.
  static std::shared_ptr<PythonScene> from_file(const std::filesystem::path& path, int threads);

  /// The object's number. Throws TypeError, ValueError, MeshError.
  std::size_t add(const py::object& vertices, const py::object& triangles, const py::object& transform,
                  SceneObject object);
  /// Those of the objects as they are now. They stay as they are when objects are added.
  std::shared_ptr<const Casters> casters();

  const Scene& scene() const { return scene_; }
  int threads() const { return threads_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Throws IndexError.
  const SceneObject& object(std::ptrdiff_t i) const;
  bool has_camera() const { return has_camera_; }
  void set_camera(const Camera& camera);
  void set_lights(std::vector<Light> lights) { scene_.lights = std::move(lights); }

 private:
  Scene scene_;
  std::vector<std::string> warnings_;
  std::shared_ptr<const Casters> casters_;
  int threads_;
  bool has_camera_ = false;
};

}  // namespace penumbra::python
