// Figures of the benchmarks: printed as they are measured, and written as data. The tables of docs/ are made
// from the files (tests/docs/tables.py).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace penumbra::bench {

/// The middle of the values, and where a quarter of them lies below and above.
struct Spread {
  double low = 0.0, median = 0.0, high = 0.0;
};
Spread spread_of(std::vector<double> values);

/// All figures of one run of penumbra_bench.
class Record {
 public:
  /// Figures that follow belong to this part of the benchmarks.
  void begin(const std::string& part);
  /// A figure that was measured once for each value. `name` is a path, from the scene down to the quantity.
  void add(const std::string& name, const std::string& unit, const std::vector<double>& values);
  /// A figure that does not vary: a count, an error.
  void add(const std::string& name, const std::string& unit, double value);
  /// What draws, as OpenGL names it.
  void set_renderer(const std::string& renderer) { renderer_ = renderer; }

  /// Writes the machine and the figures as JSON. Where the file exists its parts of the same names are
  /// replaced, all others stay. Throws SystemError where it cannot be written, std::runtime_error where it is
  /// no file of figures or was measured on another processor.
  void write(const std::filesystem::path& path, const std::string& commit) const;

 private:
  nlohmann::json parts_ = nlohmann::json::object();
  std::string part_, renderer_;
};

}  // namespace penumbra::bench
