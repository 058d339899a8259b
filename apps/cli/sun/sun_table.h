// What penumbra sun writes: a row for each time, hours and contacts.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <vector>

#include "apps/cli/sun/receiver_set.h"
#include "apps/cli/sun/sun_arguments.h"

namespace penumbra::apps {

/// Rows of visibilities as they are found: CSV with time, azimuth and elevation before them, or NPY of shape
/// (times, receivers).
class SunTable {
 public:
  /// Begins the file. Refers to the stream; null: nothing is written.
  SunTable(std::ostream* out, bool npy, const SunTimes& times, const SunSite& site, std::size_t receivers);
  void add(double time, std::span<const float> seen);

 private:
  std::ostream* out_;
  bool npy_;
  int offset_;
  SunSite site_;
};

/// CSV of x, y, z and hours, or NPY of hours alone.
void write_hours(const std::filesystem::path& path, const ReceiverSet& receivers,
                 std::span<const float> hours);

/// CSV of receiver, time and kind. In order of receivers and times.
void write_contacts(const std::filesystem::path& path, std::span<const SunContact> contacts, int offset);

}  // namespace penumbra::apps
