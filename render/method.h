// Methods: every way to find what receivers see of a light, each behind one registration.
//
// A method is its code, a description (MethodInfo) and what makes it. The command line, the viewer and
// --stats go over methods(), so that none of them has to be changed for a new one. Add one by
// register_method, from inside the library or from outside.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/light/light.h"
#include "penumbra/render/method_option.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "penumbra/render/support/counts.h"
#include "penumbra/render/support/decision.h"
#include "penumbra/render/support/texture_picture.h"

namespace penumbra {

class RayScene;
namespace detail {
struct BoxedGroups;
}  // namespace detail

/// What a method is asked. Everything is owned by the caller and stays until the call returns.
struct MethodInput {
  /// Rays among the objects (internal header render/rays/ray_scene.h), and the threads to work on.
  const RayScene& rays;
  const LightShape& light;
  const Receivers& receivers;
  /// All of the method's options, each within its domain.
  const OptionValues& options;
  /// O is wanted, too.
  bool with_unoccluded = false;
  /// MethodResult::textures is wanted.
  bool keep_textures = false;
  const Progress& progress;
  /// The receivers in groups (internal header render/receivers/receiver_box.h), where the caller has made
  /// them already.
  const detail::BoxedGroups* groups = nullptr;
};

struct MethodResult {
  /// No receiver sees any of the light, which a plan has found out without a look at each. What there is one
  /// a receiver of may then be empty. Only by the methods `auto` and `plan`.
  bool is_dark = false;
  /// V, one a receiver: the fraction of the light's area that is unblocked and above the receiver's horizon.
  /// 1 where there is no receiver, 0 behind the light's plane.
  std::vector<float> visibility;
  /// O, one a receiver: the same without the horizon. Empty unless it was asked for.
  std::vector<float> unoccluded;
  /// Certificates, one a receiver: -1 not certified, 0 wholly lit, 1 partly lit, 2 in umbra or behind the
  /// light's plane. Empty where the method certifies nothing.
  std::vector<std::int8_t> region;
  /// In order; what every call needs.
  StageTimes stages;
  /// What was done once, for this call and those that follow.
  StageTimes setup;
  Counts counts;
  /// What drew or traced it: OpenGL's renderer string, say. Empty: rays on the processor.
  std::string renderer;
  /// What the method decided by itself, and why.
  std::vector<Decision> decisions;
  /// What the method's textures hold, to look at; only where asked for.
  std::vector<TexturePicture> textures;
};

/// One way to find visibility, kept from call to call so that what does not change is not made again. What
/// has changed it finds out itself: by the light's numbers and by Receivers::revision. The objects are those
/// that it was made with; so are those of the rays, which may be others each time.
class Method {
 public:
  virtual ~Method() = default;
  /// Throws UsageError where the light or the receivers are of a kind that the method does not take,
  /// Cancelled.
  virtual MethodResult run(const MethodInput& input) = 0;
  /// The next call finds everything anew but for one-time set-up, though nothing has changed: for timing.
  virtual void forget() {}
};

struct MethodInfo {
  /// As the command line has it: lower case with hyphens.
  std::string name;
  /// One line: how visibility is computed.
  std::string summary;
  /// The lights that it takes. A point light is a disk of radius 0; all methods but `none` then give the hard
  /// shadow.
  bool takes_disks = true, takes_rectangles = false, takes_distant = false;
  /// Receivers must be a picture's pixels, with normals, objects and faces.
  bool needs_pixels = false;
  bool needs_opengl = false;
  /// Gives MethodResult::region.
  bool certifies = false;
  /// Gives MethodResult::unoccluded where it is asked for.
  bool gives_unoccluded = false;
  /// Gives independent samples by the options samples and seed, whose mean over seeds converges to V.
  bool converges = false;
  std::vector<OptionSchema> options;
  /// Makes the method for a scene's objects, which stay as they are for as long as the method lives. Lights
  /// and camera are left out.
  std::function<std::unique_ptr<Method>(const Scene& objects)> make;
};

/// Adds a method to methods(). Not while another thread uses them: do it at the start of the program, and so
/// call register_drawing_methods() (renderer.h). Throws UsageError where the name is empty or taken, where an
/// option's default is outside of its domain, where an option's name stands for something else in another
/// method, or where `converges` is set without options samples and seed.
void register_method(MethodInfo info);

/// All methods in the order of registration; those of penumbra::visibility first. References stay valid.
const std::deque<MethodInfo>& methods();

/// Throws UsageError that lists the names.
const MethodInfo& method_named(std::string_view name);

/// The method where the library is not told another one, and that others are compared with: its areas are
/// exact.
inline constexpr const char* kDefaultMethod = "silhouette";

/// Throws UsageError that names the method where it does not take this light.
void require_taken(const MethodInfo& method, const LightShape& light);

/// Throws UsageError that names the method where it does not take this light, these receivers, or a request
/// for O.
void require_taken(const MethodInfo& method, const LightShape& light, const Receivers& receivers,
                   bool with_unoccluded = false);

/// Throws UsageError for a name that no method's option has.
void require_known(const OptionValues& options);

/// Throws UsageError where a method from outside has not answered for every receiver.
void require_complete(const MethodInfo& method, const MethodResult& result, std::size_t receivers);

/// Every option of every method once, in their order.
std::vector<OptionSchema> all_options();

}  // namespace penumbra
