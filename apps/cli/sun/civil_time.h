// Dates, times and durations as people write them (ISO 8601), and seconds since 1970.
#pragma once

#include <string>

namespace penumbra::apps {

struct CivilTime {
  /// Seconds since 1970 UTC; leap seconds do not count.
  double unix_time = 0.0;
  /// Of the time zone, seconds ahead of UTC.
  int offset = 0;
};

/// "2026-06-21", "2026-06-21T04:30", "2026-06-21T04:30:15.5", with "Z" or "+02:00" behind; without either it
/// is UTC. Throws UsageError that names the option.
CivilTime parse_time(const std::string& option, const std::string& text);

/// Seconds: "1h", "15min", "30s", "1d"; also with a fraction. Throws UsageError that names the option unless
/// it is above 0.
double parse_duration(const std::string& option, const std::string& text);

/// "2026-06-21T04:30:15+02:00", to the nearest second, or to so many digits behind it.
std::string time_text(double unix_time, int offset, int digits = 0);

}  // namespace penumbra::apps
