#include "penumbra/render/method.h"

#include <algorithm>

#include "penumbra/mesh/error.h"
#include "render/backprojection/backprojection_method.h"
#include "render/depth_complexity/depth_complexity_method.h"
#include "render/layered_attenuation/layered_attenuation_method.h"
#include "render/pcss/pcss_method.h"
#include "render/penumbra_maps/penumbra_maps_method.h"
#include "render/plan/auto_method.h"
#include "render/rays/ray_methods.h"
#include "render/shadow_volumes/shadow_volumes_method.h"
#include "render/silhouette/silhouette_method.h"
#include "render/smoothies/smoothies_method.h"
#include "render/soft_shadow_volumes/soft_shadow_volumes_method.h"
#include "render/support/nearest_word.h"
#include "render/variance/variance_method.h"
#include "render/view_samples/view_samples_method.h"

namespace penumbra {
namespace {

bool has_option(const MethodInfo& method, std::string_view name) {
  return std::any_of(method.options.begin(), method.options.end(),
                     [&](const OptionSchema& option) { return option.name == name; });
}

std::vector<std::string> names_of(const std::vector<OptionSchema>& options) {
  std::vector<std::string> names;
  for (const OptionSchema& option : options) names.push_back(option.name);
  return names;
}

void require_sound(const MethodInfo& info) {
  if (info.name.empty() || !info.make) throw UsageError("a method needs a name and what makes it");
  if (info.converges && !(has_option(info, "samples") && has_option(info, "seed")))
    throw UsageError("method " + info.name + " converges, but has no options samples and seed");
  for (const OptionSchema& option : info.options) {
    option.require_allowed(option.usual);
    if (option.draft) option.require_allowed(*option.draft);
  }
}

void add(std::deque<MethodInfo>& known, MethodInfo info) {
  require_sound(info);
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
  add(known, auto_method());
  add(known, reference_method());
  add(known, rays_method());
  add(known, depth_complexity_method());
  add(known, pcss_method());
  add(known, variance_method());
  add(known, penumbra_maps_method());
  add(known, smoothies_method());
  add(known, backprojection_method());
  add(known, layered_attenuation_method());
  add(known, shadow_volumes_method());
  add(known, soft_shadow_volumes_method());
  add(known, view_samples_method());
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
  std::vector<std::string> names;
  std::string known;
  for (const MethodInfo& method : methods()) {
    if (method.name == name) return method;
    names.push_back(method.name);
    known += (known.empty() ? "" : ", ") + method.name;
  }
  throw UsageError("unknown method '" + std::string(name) + "'" + did_you_mean(name, names) +
                   ": use one of " + known);
}

void require_taken(const MethodInfo& method, const LightShape& light) {
  const std::string who = "method " + method.name;
  if (!method.takes_distant && std::holds_alternative<DistantLight>(light))
    throw UsageError(who + " does not take distant lights");
  if (!method.takes_rectangles) require_circular(light, who);
  if (!method.takes_disks && std::holds_alternative<DiskLight>(light))
    throw UsageError(who + " does not take disk lights");
}

void require_taken(const MethodInfo& method, const LightShape& light, const Receivers& receivers,
                   bool with_unoccluded) {
  require_taken(method, light);
  const std::string who = "method " + method.name;
  if (with_unoccluded && !method.gives_unoccluded && receivers.has_normals())
    throw UsageError(who + " does not give the unoccluded fraction; leave the normals out, or use method " +
                     kDefaultMethod);
  if (method.needs_pixels && receivers.size() > 0 &&
      (receivers.normals.empty() || receivers.objects.empty() || receivers.faces.empty()))
    throw UsageError(who + " needs pixels with normals, objects and faces");
  if (method.needs_pixels && !receivers.are_pixels())
    throw UsageError("method " + method.name + " needs a picture's pixels as receivers; use method " +
                     kDefaultMethod + " for other points");
}

void require_known(const OptionValues& options) {
  for (const auto& [name, value] : options)
    if (std::none_of(methods().begin(), methods().end(),
                     [&, key = name](const MethodInfo& method) { return has_option(method, key); }))
      throw UsageError("no method has an option " + name + did_you_mean(name, names_of(all_options())));
}

void require_complete(const MethodInfo& method, const MethodResult& result, std::size_t receivers) {
  const auto fits = [&](std::size_t size, bool optional) {
    return size == receivers || (optional && size == 0);
  };
  if (result.is_dark) return;
  if (!fits(result.visibility.size(), false) || !fits(result.unoccluded.size(), true) ||
      !fits(result.region.size(), true))
    throw UsageError("method " + method.name + " has not answered for every receiver");
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
