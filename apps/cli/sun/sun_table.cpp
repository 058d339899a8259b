#include "apps/cli/sun/sun_table.h"

#include <cstdio>
#include <ostream>
#include <string>

#include "mesh/io/npy.h"
#include "mesh/io/write_file.h"

namespace penumbra::apps {
namespace {

/// With so many digits that nothing is lost which counts.
std::string number(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

void write_floats(std::ostream& out, std::span<const float> values) {
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
}

bool is_npy(const std::filesystem::path& path) {
  return extension_of(path) == ".npy";
}

}  // namespace

SunTable::SunTable(std::ostream* out, bool npy, const SunTimes& times, const SunSite& site,
                   std::size_t receivers)
    : out_(out), npy_(npy), offset_(times.from.offset), site_(site) {
  if (!out_) return;
  if (npy_) {
    detail::write_npy_header(*out_, {times.count, receivers});
    return;
  }
  *out_ << "time,azimuth,elevation";
  for (std::size_t i = 0; i < receivers; ++i) *out_ << "," << i;
  *out_ << "\n";
}

void SunTable::add(double time, std::span<const float> seen) {
  if (!out_) return;
  if (npy_) return write_floats(*out_, seen);
  const SunPosition sun = sun_position(time, site_);
  std::string line = time_text(time, offset_);
  const auto add = [&line](double value, int digits) { line.append(1, ',').append(number(value, digits)); };
  add(sun.azimuth, 7);
  add(sun.elevation, 7);
  for (const float value : seen) add(value, 6);
  *out_ << line << "\n";
}

void write_hours(const std::filesystem::path& path, const ReceiverSet& receivers,
                 std::span<const float> hours) {
  write_file(path, [&](std::ostream& out) {
    if (is_npy(path)) {
      detail::write_npy_header(out, {hours.size()});
      return write_floats(out, hours);
    }
    out << "x,y,z,hours\n";
    for (std::size_t i = 0; i < hours.size(); ++i) {
      const Vec3& p = receivers.points[i];
      out << number(p.x, 17) << "," << number(p.y, 17) << "," << number(p.z, 17) << "," << number(hours[i], 6)
          << "\n";
    }
  });
}

void write_contacts(const std::filesystem::path& path, std::span<const SunContact> contacts, int offset) {
  write_file(path, [&](std::ostream& out) {
    out << "receiver,time,event\n";
    for (const SunContact& contact : contacts)
      out << contact.receiver << "," << time_text(contact.time, offset, 1) << "," << name_of(contact.kind)
          << "\n";
  });
}

}  // namespace penumbra::apps
