#include "tests/bench/record.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <ostream>
#include <stdexcept>

#include "apps/common/machine.h"
#include "mesh/io/write_file.h"

namespace penumbra::bench {
namespace {

std::string today() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

nlohmann::json read_record(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) return nlohmann::json::object();
  nlohmann::json record = nlohmann::json::parse(in);
  if (!record.contains("machine") || !record.contains("parts"))
    throw std::runtime_error(path.string() + ": is no file of figures; choose another name");
  return record;
}

/// Whole numbers stay as they are.
double five_digits(double value) {
  if (value == std::round(value)) return value;
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return std::strtod(text, nullptr);
}

/// One figure a line, so that differences between two runs can be read.
void write_lines(std::ostream& out, const nlohmann::json& record) {
  out << "{\n\"machine\": " << record["machine"]
      << ",\n\"renderer\": " << record.value("renderer", nlohmann::json("")) << ",\n\"parts\": {";
  const char* before_part = "\n";
  for (const auto& [name, part] : record["parts"].items()) {
    out << before_part << nlohmann::json(name) << ": {\"commit\": " << part["commit"]
        << ", \"date\": " << part["date"] << ", \"figures\": {";
    const char* before = "\n ";
    for (const auto& [key, figure] : part["figures"].items()) {
      out << before << nlohmann::json(key) << ": " << figure;
      before = ",\n ";
    }
    out << "}}";
    before_part = ",\n";
  }
  out << "}\n}\n";
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values[n / 4], values[n / 2], values[n - 1 - n / 4]};
}

void Record::begin(const std::string& part) {
  part_ = part;
  std::printf("\n%s\n", part.c_str());
}

void Record::add(const std::string& name, const std::string& unit, const std::vector<double>& values) {
  const Spread s = spread_of(values);
  parts_[part_][name] = {{"unit", unit},
                         {"median", five_digits(s.median)},
                         {"low", five_digits(s.low)},
                         {"high", five_digits(s.high)},
                         {"runs", values.size()}};
  std::printf("  %-64s %12.5g %-10s", name.c_str(), s.median, unit.c_str());
  if (values.size() > 1) std::printf(" [%.5g, %.5g] of %zu", s.low, s.high, values.size());
  std::printf("\n");
  std::fflush(stdout);
}

void Record::add(const std::string& name, const std::string& unit, double value) {
  add(name, unit, std::vector<double>{value});
}

void Record::write(const std::filesystem::path& path, const std::string& commit) const {
  nlohmann::json record = read_record(path);
  const nlohmann::json machine = apps::describe_machine();
  if (record.contains("machine") && record["machine"]["processor"] != machine["processor"])
    throw std::runtime_error(path.string() + ": was measured on another processor; choose another name");
  record["machine"] = machine;
  if (!renderer_.empty()) record["renderer"] = renderer_;
  for (const auto& [part, figures] : parts_.items())
    record["parts"][part] = {{"commit", commit}, {"date", today()}, {"figures", figures}};
  penumbra::write_file(path, [&](std::ostream& out) { write_lines(out, record); });
}

}  // namespace penumbra::bench
