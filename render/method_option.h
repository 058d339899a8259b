// Options of methods as data: what an option is called, what it may be, what it is by default.
//
// A schema is the only place in which an option's range stands. The command line, the viewer, --stats, the
// checks of the library, benchmarks and tests read it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace penumbra {

/// A number without a sign, a real number, or a word.
using OptionValue = std::variant<std::uint64_t, double, std::string>;
/// As a person writes it: the shortest decimals that read back exactly.
std::string to_text(const OptionValue& value);

/// What an option may be.
struct IntegerRange {
  std::uint64_t low, high;
  /// Also allowed, outside of the range, with a meaning of its own that the help gives.
  std::vector<std::uint64_t> also{};
};
struct IntegerChoice {
  std::vector<std::uint64_t> values;
};
struct RealRange {
  double low, high;
  /// Whether `low` itself is allowed.
  bool low_included = true;
  /// Words that stand for something else than a number.
  std::vector<std::string> words{};
};
struct WordChoice {
  std::vector<std::string> words;
};
using OptionDomain = std::variant<IntegerRange, IntegerChoice, RealRange, WordChoice>;

struct OptionSchema {
  /// Lower case with hyphens. The command line puts two hyphens before it, --stats takes it as it is.
  std::string name;
  OptionDomain domain;
  OptionValue usual;
  /// Of numbers, such as "light radii"; empty for words and plain numbers.
  std::string unit{};
  /// One sentence: what the option decides.
  std::string help;
  /// A value that costs less, for a picture while something moves; of a number: the most that it may then be.
  std::optional<OptionValue> draft{};
  /// Values worth comparing, from the cheapest on (penumbra study). Not set: chosen by the domain. Empty: the
  /// option changes neither time nor accuracy by intent.
  std::optional<std::vector<OptionValue>> steps{};

  /// "4 to 1024 rows", "4, 8, 12 or 16", "auto, orthographic or a number above 0".
  std::string allowed() const;
  /// "'edg' is not allowed (did you mean edge?); give edge or distances".
  std::string refusal(std::string_view text) const;
  /// Throws UsageError that names the option, the text and what is allowed.
  OptionValue parse(std::string_view text) const;
  /// Throws UsageError where the value is of another type or outside of the domain.
  void require_allowed(const OptionValue& value) const;
};
bool operator==(const OptionSchema& a, const OptionSchema& b);

/// Values by the options' names. What is not set has its default.
using OptionValues = std::map<std::string, OptionValue, std::less<>>;

/// All of a schema's options. Throws UsageError for a value that the schema does not allow; values of options
/// that are not in the schema are left out.
OptionValues completed(const std::vector<OptionSchema>& schema, const OptionValues& values);

/// Throws UsageError where the option of that name does not allow the value. The schema must have it.
void require_allowed(const std::vector<OptionSchema>& schema, std::string_view name,
                     const OptionValue& value);

/// For methods, of completed values.
std::uint64_t integer_of(const OptionValues& values, std::string_view name);
double real_of(const OptionValues& values, std::string_view name);
const std::string& word_of(const OptionValues& values, std::string_view name);

}  // namespace penumbra
