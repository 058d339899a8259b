#include "penumbra/render/method.h"

#include <algorithm>

#include "penumbra/mesh/error.h"
#include "render/rays/ray_methods.h"
#include "render/silhouette/silhouette_method.h"

namespace penumbra {
namespace {

void add(std::deque<MethodInfo>& known, MethodInfo info) {
  for (const MethodInfo& other : known) {
    if (other.name == info.name) throw UsageError("there is a method '" + info.name + "' already");
    for (const OptionSchema& mine : info.options)
      for (const OptionSchema& theirs : other.options)
        if (mine.name == theirs.name && !(mine == theirs))
          throw UsageError("option " + mine.name + " of method " + info.name +
                           " is another one than that of method " + other.name + "; give it another name");
  }
  known.push_back(std::move(info));
}

/// The methods that need no OpenGL: one line each.
std::deque<MethodInfo> built_in() {
  std::deque<MethodInfo> known;
  add(known, silhouette_method());
  add(known, reference_method());
  add(known, rays_method());
  add(known, hard_method());
  add(known, no_shadow_method());
  return known;
}

std::deque<MethodInfo>& registry() {
  static std::deque<MethodInfo> known = built_in();
  return known;
}

}  // namespace

void register_method(MethodInfo info) {
  add(registry(), std::move(info));
}

const std::deque<MethodInfo>& methods() {
  return registry();
}

const MethodInfo& method_named(std::string_view name) {
  std::string known;
  for (const MethodInfo& method : methods()) {
    if (method.name == name) return method;
    known += (known.empty() ? "" : ", ") + method.name;
  }
  throw UsageError("unknown method '" + std::string(name) + "': use one of " + known);
}

void require_taken(const MethodInfo& method, const LightShape& light, const Receivers& receivers) {
  if (!method.takes_rectangles) require_disk(light, "method " + method.name);
  if (method.needs_pixels && !receivers.are_pixels())
    throw UsageError("method " + method.name + " needs a picture's pixels as receivers; use method " +
                     kDefaultMethod + " for other points");
}

std::vector<OptionSchema> all_options() {
  std::vector<OptionSchema> options;
  for (const MethodInfo& method : methods())
    for (const OptionSchema& option : method.options)
      if (std::none_of(options.begin(), options.end(),
                       [&](const OptionSchema& o) { return o.name == option.name; }))
        options.push_back(option);
  return options;
}

}  // namespace penumbra
