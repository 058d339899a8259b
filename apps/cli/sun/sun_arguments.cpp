#include "apps/cli/sun/sun_arguments.h"

#include <cmath>
#include <cstdio>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {

SunTimes times_of(const SunArguments& arguments) {
  constexpr double kMost = 1e7;
  SunTimes times{parse_time("--from", arguments.from), parse_duration("--step", arguments.step)};
  const double span = parse_time("--to", arguments.to).unix_time - times.from.unix_time;
  if (!(span >= 0.0)) throw UsageError("--to " + arguments.to + " is before --from " + arguments.from);
  // A step that fits by a hair counts.
  const double steps = std::floor(span / times.step * (1.0 + 1e-12) + 1e-9);
  if (steps >= kMost)
    throw UsageError("--step " + arguments.step + " makes " + std::to_string(steps) +
                     " times of this period; ten million are the most: take a longer step");
  times.count = static_cast<std::size_t>(steps) + 1;
  return times;
}

Vec3 parse_axis(const std::string& option, const std::string& text) {
  std::string word = text;
  const double sign = word.starts_with('-') ? -1.0 : 1.0;
  if (word.starts_with('-') || word.starts_with('+')) word.erase(0, 1);
  for (int k = 0; k < 3; ++k)
    if (word == std::string(1, static_cast<char>('x' + k))) {
      Vec3 axis(0.0);
      axis[k] = sign;
      return axis;
    }
  Vec3 axis(0.0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &axis.x, &axis.y, &axis.z, &rest) == 3 &&
      std::isfinite(axis.x + axis.y + axis.z))
    return axis;
  throw UsageError(option + " " + text +
                   ": is no direction; give x, -x, y, -y, z, -z or three numbers, 0,0,1");
}

void require_usable(const SunArguments& arguments) {
  if (arguments.points.empty() == arguments.object.empty())
    throw UsageError(
        "say where the sun is looked at: --points FILE, or --object with --at faces or vertices");
  std::vector<std::filesystem::path> destinations;
  bool any = false;
  for (const Output& output : arguments.outputs()) {
    destinations.push_back(output.path);
    any = any || !output.path.empty();
    require_writable(output.path);
  }
  if (!any) throw UsageError("nothing to do; give --output, --hours, --contacts or --report");
  require_one_stdout(destinations);
  if (!arguments.output.empty()) require_extension("--output", arguments.output, {".csv", ".npy"}, true);
  if (!arguments.hours.empty()) require_extension("--hours", arguments.hours, {".csv", ".npy"}, true);
  if (!arguments.contacts.empty()) require_extension("--contacts", arguments.contacts, {".csv"}, true);
  require_apart(arguments.outputs(), {arguments.scene.path, arguments.points});
  const MethodInfo& method = method_named(arguments.method);
  require_taken(method, DistantLight{});
  if (method.needs_pixels) throw UsageError("method " + method.name + " takes pictures alone; use another");
  if (!arguments.contacts.empty() && method.name != kDefaultMethod)
    throw UsageError("--contacts needs visibility without noise; use --method " +
                     std::string(kDefaultMethod));
  times_of(arguments);
}

}  // namespace penumbra::apps
