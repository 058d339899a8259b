// What penumbra sun was asked for, and what of it can be refused before any file is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/cli/sun/civil_time.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "penumbra/render/method.h"
#include "penumbra/render/sun/sun_exposure.h"

namespace penumbra::apps {

struct SunArguments {
  CommonOptions common;
  SceneInput scene;
  SunSky sky;
  std::string from, to, step = "1h", up = "y", north = "-z";
  std::filesystem::path points;
  std::string object, at = "faces";
  std::string method = kDefaultMethod;
  OptionValues options;
  std::filesystem::path output, hours, contacts, report;

  std::vector<Output> outputs() const {
    return {{"--output", output}, {"--hours", hours}, {"--contacts", contacts}, {"--report", report}};
  }
};

/// The times that are looked at: from, from + step and so on up to `to`.
struct SunTimes {
  CivilTime from;
  double step = 0.0;
  std::size_t count = 0;

  double at(std::size_t k) const { return from.unix_time + static_cast<double>(k) * step; }
};

/// Throws UsageError for times in the wrong order and for more than ten million of them.
SunTimes times_of(const SunArguments& arguments);

/// "y", "-z" or three numbers, "0,0,1". Throws UsageError that names the option.
Vec3 parse_axis(const std::string& option, const std::string& text);

/// Throws UsageError and SystemError for all that can be refused without the scene.
void require_usable(const SunArguments& arguments);

}  // namespace penumbra::apps
