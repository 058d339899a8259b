// The one call for visibility: which fraction of a light each receiver sees.
//
//   casters     what hides the light, prepared once            (Casters)
//   light       a disk, near or distant, or a rectangle        (light/light.h)
//   receivers   points, with or without normals and faces      (receivers/receivers.h)
//   options     the method and its options                     (method.h)
//
// A picture asks the same methods; its camera makes the receivers (renderer.h).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "penumbra/render/method.h"

namespace penumbra {

/// What hides lights: the objects that cast, with all that is prepared for them once. Copies of meshes are
/// shared, not made.
class Casters {
 public:
  /// All of the meshes cast. `threads`: how many are used by every call; 0: all cores.
  explicit Casters(std::span<const TriangleMesh> meshes, int threads = 0);
  /// Those of the objects that cast; receivers may lie on any of them.
  explicit Casters(std::vector<SceneObject> objects, int threads = 0);
  ~Casters();
  Casters(Casters&&) noexcept;
  Casters& operator=(Casters&&) noexcept;

  const std::vector<SceneObject>& objects() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

struct VisibilityOptions {
  std::string method = kDefaultMethod;
  /// Of the method; those of other methods have no effect.
  OptionValues options{};
  /// MethodResult::unoccluded is wanted as well as visibility. Of receivers without normals both are equal,
  /// by any method; with normals only some methods give it (MethodInfo::gives_unoccluded).
  bool with_unoccluded = false;
  Progress progress{};
};

/// Receivers may come in any order: they are sorted for coherence inside, and answered in theirs. Calls with
/// the same casters wait for each other. Methods that need OpenGL are to be called, and their casters
/// destroyed, by one thread: contexts are that thread's. Cost: see each method. Throws UsageError for an
/// unknown method, options outside their domain, a light or receivers that the method does not take, arrays
/// of different lengths, numbers that are not finite; Cancelled.
MethodResult visibility(const Casters& casters, const LightShape& light, const Receivers& receivers,
                        const VisibilityOptions& options = {});

/// Under several lights, one result for each in their order. What does not depend on the light is made once.
/// The results hold lights · receivers numbers.
std::vector<MethodResult> visibility(const Casters& casters, std::span<const LightShape> lights,
                                     const Receivers& receivers, const VisibilityOptions& options = {});

}  // namespace penumbra
