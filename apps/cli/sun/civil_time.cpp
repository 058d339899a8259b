#include "apps/cli/sun/civil_time.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <regex>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr double kDay = 86400.0;

[[noreturn]] void refuse_time(const std::string& option, const std::string& text, const std::string& why) {
  throw UsageError(option + " " + text + ": " + why +
                   "; write a time as 2026-06-21T04:30+02:00 (without an offset it is UTC)");
}

int number(const std::ssub_match& match) {
  return match.matched ? std::atoi(match.str().c_str()) : 0;
}

std::string offset_text(int offset) {
  if (offset == 0) return "Z";
  char text[16];
  const int minutes = std::abs(offset) / 60;
  std::snprintf(text, sizeof text, "%c%02d:%02d", offset < 0 ? '-' : '+', minutes / 60 % 100, minutes % 60);
  return text;
}

}  // namespace

CivilTime parse_time(const std::string& option, const std::string& text) {
  static const std::regex kTime(
      R"((-?\d{4})-(\d\d)-(\d\d)(?:[T ](\d\d):(\d\d)(?::(\d\d(?:\.\d+)?))?)?(Z|([+-])(\d\d):?(\d\d))?)");
  std::smatch m;
  if (text.size() > 64 || !std::regex_match(text, m, kTime)) refuse_time(option, text, "is no date or time");
  const std::chrono::year_month_day date(std::chrono::year(number(m[1])),
                                         std::chrono::month(static_cast<unsigned>(number(m[2]))),
                                         std::chrono::day(static_cast<unsigned>(number(m[3]))));
  if (!date.ok()) refuse_time(option, text, "there is no such day");
  const int hour = number(m[4]), minute = number(m[5]);
  const double second = m[6].matched ? std::atof(m[6].str().c_str()) : 0.0;
  if (hour > 24 || minute > 59 || second >= 60.0 || (hour == 24 && (minute > 0 || second > 0.0)))
    refuse_time(option, text, "there is no such time of the day");
  if (number(m[9]) > 18 || number(m[10]) > 59) refuse_time(option, text, "there is no such offset");
  const int ahead = (number(m[9]) * 60 + number(m[10])) * 60 * (m[8].str() == "-" ? -1 : 1);
  const double days = static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  return {days * kDay + hour * 3600.0 + minute * 60.0 + second - ahead, ahead};
}

double parse_duration(const std::string& option, const std::string& text) {
  static const std::regex kDuration(R"((\d+(?:\.\d*)?|\.\d+)(s|min|h|d))");
  std::smatch m;
  if (text.size() <= 32 && std::regex_match(text, m, kDuration)) {
    const std::string unit = m[2].str();
    const double seconds = std::atof(m[1].str().c_str()) * (unit == "s"     ? 1.0
                                                            : unit == "min" ? 60.0
                                                            : unit == "h"   ? 3600.0
                                                                            : kDay);
    if (seconds > 0.0 && std::isfinite(seconds)) return seconds;
  }
  throw UsageError(option + " " + text + ": is no duration above 0; write 1h, 15min, 30s or 1d");
}

std::string time_text(double unix_time, int offset, int digits) {
  const double unit = std::pow(10.0, -digits);
  const double local = std::round((unix_time + offset) / unit) * unit;
  const double days = std::floor(local / kDay);
  const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(static_cast<long>(days)))};
  const double seconds = local - days * kDay;
  const int minutes = static_cast<int>(seconds / 60.0);
  char text[80];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%0*.*f", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), minutes / 60,
                minutes % 60, digits > 0 ? digits + 3 : 2, digits, seconds - 60.0 * minutes);
  return text + offset_text(offset);
}

}  // namespace penumbra::apps
