// penumbra sun: what receivers see of the sun over hours, days or a year.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <ostream>
#include <tuple>

#include "apps/cli/commands.h"
#include "apps/cli/sun/receiver_set.h"
#include "apps/cli/sun/sun_arguments.h"
#include "apps/cli/sun/sun_table.h"
#include "apps/common/messages.h"
#include "apps/common/method_options.h"
#include "apps/common/options.h"
#include "apps/common/stats.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/stage_clock.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra sun city.json --latitude 52.5 --longitude 13.4 --from 2026-06-21T03:00Z --to 2026-06-21T20:00Z --step 10min
      --points windows.csv --output seen.csv --contacts contacts.csv
  penumbra sun city.json --latitude 52.5 --longitude 13.4 --from 2026-01-01 --to 2027-01-01 --step 1h
      --object houses.off --at faces --hours hours.csv
Values are the fraction of the sun's disk that a receiver sees, 0 to 1. The scene's own lights do not count. Angles are degrees,
azimuths run from north over east. A time without an offset (Z, +02:00) is UTC.)";

/// What came of all times.
struct Outcome {
  std::vector<float> hours;
  std::vector<SunContact> contacts;
  SunCounts counts;
  double milliseconds = 0.0;
};

/// Goes over the times; `table` gets each row.
Outcome look(const SunArguments& arguments, const SunTimes& times, SunExposure& sun, std::size_t receivers,
             SunTable& table) {
  ProgressLine line("sun");
  const Progress progress = line.callback();
  Outcome out;
  std::vector<double> hours(receivers, 0.0);
  std::vector<float> before;
  for (std::size_t k = 0; k < times.count; ++k) {
    report(progress, static_cast<double>(k) / static_cast<double>(times.count));
    std::vector<float> now = sun.seen(times.at(k));
    if (k > 0) {
      for (std::size_t i = 0; i < receivers; ++i) hours[i] += 0.5 * (double{before[i]} + now[i]);
      if (!arguments.contacts.empty()) {
        const auto more = sun.contacts(times.at(k - 1), before, times.at(k), now);
        out.contacts.insert(out.contacts.end(), more.begin(), more.end());
      }
    }
    table.add(times.at(k), now);
    before = std::move(now);
  }
  for (const double sum : hours) out.hours.push_back(static_cast<float>(sum * times.step / 3600.0));
  std::ranges::sort(out.contacts, {},
                    [](const SunContact& c) { return std::tuple(c.receiver, c.time, c.kind); });
  out.counts = sun.counts();
  return out;
}

struct Summary {
  double least, mean, most;
};
Summary summary_of(std::span<const float> hours) {
  const auto [least, most] = std::ranges::minmax(hours);
  return {least, std::accumulate(hours.begin(), hours.end(), 0.0) / static_cast<double>(hours.size()), most};
}

nlohmann::json json_of(const SunArguments& arguments, const SunTimes& times, const Outcome& outcome) {
  const Summary hours = summary_of(outcome.hours);
  const SunSite& site = arguments.sky.site;
  return {{"method", arguments.method},
          {"options", to_json(arguments.options)},
          {"latitude", site.latitude},
          {"longitude", site.longitude},
          {"pressure", site.pressure},
          {"temperature", site.temperature},
          {"up", arguments.up},
          {"north", arguments.north},
          {"from", time_text(times.at(0), times.from.offset)},
          {"to", time_text(times.at(times.count - 1), times.from.offset)},
          {"step_seconds", times.step},
          {"steps", times.count},
          {"receivers", outcome.hours.size()},
          {"times", outcome.counts.times},
          {"nights", outcome.counts.nights},
          {"visibilities", outcome.counts.receivers},
          {"contacts", outcome.contacts.size()},
          {"hours", {{"least", hours.least}, {"mean", hours.mean}, {"most", hours.most}}},
          {"milliseconds", outcome.milliseconds},
          {"threads", used_threads(arguments.common.threads)}};
}

std::string text_of(const SunTimes& times, const Outcome& outcome) {
  const Summary hours = summary_of(outcome.hours);
  char text[400];
  std::snprintf(text, sizeof text,
                "%zu receivers, %zu times, %zu of them at night; %zu visibilities in %.2f s\n"
                "sun: %.2f to %.2f hours, mean %.2f\n",
                outcome.hours.size(), times.count, outcome.counts.nights, outcome.counts.receivers,
                outcome.milliseconds / 1000.0, hours.least, hours.most, hours.mean);
  return text;
}

ReceiverSet receivers_of(const SunArguments& arguments, const Scene& scene) {
  if (!arguments.points.empty()) return read_receivers(arguments.points);
  return receivers_on(scene, arguments.object,
                      arguments.at == "faces" ? ReceiverPlace::kFaces : ReceiverPlace::kVertices);
}

void run(SunArguments& arguments) {
  require_usable(arguments);
  const SunTimes times = times_of(arguments);
  arguments.sky.axes = {parse_axis("--up", arguments.up), parse_axis("--north", arguments.north)};
  const ThreadLimit limit(arguments.common.threads);
  const Scene scene = load(arguments.scene);
  require_apart(arguments.outputs(), scene.files);
  const ReceiverSet receivers = receivers_of(arguments, scene);
  if (receivers.size() == 0) throw UsageError("--object " + arguments.object + ": has no face with an area");
  const Casters casters(scene.objects, arguments.common.threads);
  SunExposure sun(casters, receivers.receivers(), arguments.sky,
                  {.method = arguments.method, .options = arguments.options});
  Outcome outcome;
  StageClock clock;
  const auto look_and_write = [&](std::ostream* out) {
    SunTable table(out, extension_of(arguments.output) == ".npy", times, arguments.sky.site,
                   receivers.size());
    outcome = look(arguments, times, sun, receivers.size(), table);
  };
  if (arguments.output.empty())
    look_and_write(nullptr);
  else
    write_file(arguments.output, [&](std::ostream& out) { look_and_write(&out); });
  clock.finish("sun");
  outcome.milliseconds = clock.stages().front().milliseconds;
  if (!arguments.hours.empty()) write_hours(arguments.hours, receivers, outcome.hours);
  if (!arguments.contacts.empty()) write_contacts(arguments.contacts, outcome.contacts, times.from.offset);
  if (!arguments.report.empty()) write_json(arguments.report, json_of(arguments, times, outcome));
  const auto outputs = arguments.outputs();
  for (const Output& output : outputs)
    if (!output.path.empty()) say_written(arguments.common.verbose, output.path);
  if (std::ranges::none_of(outputs, [](const Output& output) { return is_standard(output.path); }))
    print(text_of(times, outcome));
}

void add_place_options(CLI::App& command, SunArguments& arguments) {
  SunSite& site = arguments.sky.site;
  command.add_option("--latitude", site.latitude, "Degrees, north positive")
      ->check(CLI::Range(-90.0, 90.0))
      ->required();
  command.add_option("--longitude", site.longitude, "Degrees, east positive")
      ->check(CLI::Range(-180.0, 360.0))
      ->required();
  command.add_option("--pressure", site.pressure, "Of the air, millibar; 0: no refraction")
      ->check(CLI::Range(0.0, 5000.0))
      ->capture_default_str();
  command.add_option("--temperature", site.temperature, "Of the air, degrees Celsius")
      ->check(CLI::Range(-272.0, 1000.0))
      ->capture_default_str();
  command.add_option("--up", arguments.up, "The scene's axis that points up: x, -x, ... or X,Y,Z")
      ->capture_default_str()
      ->type_name("AXIS");
  command.add_option("--north", arguments.north, "The scene's axis that points north")
      ->capture_default_str()
      ->type_name("AXIS");
}

void add_time_options(CLI::App& command, SunArguments& arguments) {
  command.add_option("--from", arguments.from, "The first time, 2026-06-21T04:30+02:00, say")
      ->required()
      ->type_name("TIME");
  command.add_option("--to", arguments.to, "The last time")->required()->type_name("TIME");
  command.add_option("--step", arguments.step, "From time to time: 1h, 15min, 30s, 1d")
      ->capture_default_str()
      ->type_name("DURATION");
}

void add_output_options(CLI::App& command, SunArguments& arguments) {
  const auto add = [&](const char* name, std::filesystem::path& path, const char* help) {
    command.add_option(name, path, help)->type_name("FILE");
  };
  add("-o,--output", arguments.output,
      "The fraction that each receiver sees at each time: CSV, a line a time, or NPY of shape (times, "
      "receivers)");
  add("--hours", arguments.hours, "Hours of sun of each receiver, CSV or NPY");
  add("--contacts", arguments.contacts,
      "When the sun begins and ceases to be seen, to a second: CSV of receiver, time, event");
  add("--report", arguments.report, "Counts and times as JSON; - is standard output");
}

}  // namespace

void add_sun_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("sun", "What receivers see of the sun from time to time");
  auto arguments = std::make_shared<SunArguments>();
  add_scene_input(command, arguments->scene);
  add_place_options(command, *arguments);
  add_time_options(command, *arguments);
  command
      .add_option("--points", arguments->points, "Receivers: x, y, z and perhaps a normal, CSV, NPY or PLY")
      ->type_name("FILE");
  command
      .add_option("--object", arguments->object,
                  "Receivers on one of the scene's objects or heightfields, by name or number")
      ->type_name("NAME|N");
  command.add_option("--at", arguments->at, "Its faces or its vertices")
      ->check(CLI::IsMember({"faces", "vertices"}))
      ->capture_default_str();
  add_output_options(command, *arguments);
  command.add_option("-m,--method", arguments->method, "How visibility is computed")->capture_default_str();
  add_method_options(command, arguments->options);
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
