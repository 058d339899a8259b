#include "penumbra/render/method_option.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "penumbra/mesh/error.h"
#include "render/support/nearest_word.h"

namespace penumbra {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

template <class Number>
std::string shortest(Number value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string join(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : (i + 1 == parts.size() ? " or " : ", ")) + parts[i];
  return text;
}

std::vector<std::string> texts(const std::vector<std::uint64_t>& values) {
  std::vector<std::string> out;
  out.reserve(values.size());
  for (const std::uint64_t value : values) out.push_back(shortest(value));
  return out;
}

bool holds(const std::vector<std::uint64_t>& values, std::uint64_t value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool allows(const OptionDomain& domain, const OptionValue& value) {
  const auto* integer = std::get_if<std::uint64_t>(&value);
  const auto* real = std::get_if<double>(&value);
  const auto* word = std::get_if<std::string>(&value);
  return std::visit(
      Overloaded{[&](const IntegerRange& d) {
                   return integer && ((*integer >= d.low && *integer <= d.high) || holds(d.also, *integer));
                 },
                 [&](const IntegerChoice& d) { return integer && holds(d.values, *integer); },
                 [&](const RealRange& d) {
                   if (word) return holds(d.words, *word);
                   return real && std::isfinite(*real) && *real <= d.high &&
                          (d.low_included ? *real >= d.low : *real > d.low);
                 },
                 [&](const WordChoice& d) { return word && holds(d.words, *word); }},
      domain);
}

}  // namespace

std::string to_text(const OptionValue& value) {
  return std::visit(Overloaded{[](std::uint64_t v) { return shortest(v); },
                               [](double v) { return shortest(v); }, [](const std::string& v) { return v; }},
                    value);
}

std::string OptionSchema::allowed() const {
  const std::string of = unit.empty() ? "" : " " + unit;
  return std::visit(Overloaded{[&](const IntegerRange& d) {
                                 std::string text;
                                 for (const std::uint64_t value : d.also) text += shortest(value) + " or ";
                                 if (d.low == 0 && d.high == std::numeric_limits<std::uint64_t>::max())
                                   return text + "a whole number of at most 64 bits";
                                 return text + shortest(d.low) + " to " + shortest(d.high) + of;
                               },
                               [&](const IntegerChoice& d) { return join(texts(d.values)) + of; },
                               [&](const RealRange& d) {
                                 std::vector<std::string> parts = d.words;
                                 const bool open = std::isinf(d.high);
                                 if (open)
                                   parts.push_back("a number " +
                                                   std::string(d.low_included ? "of at least " : "above ") +
                                                   shortest(d.low) + of);
                                 else
                                   parts.push_back(shortest(d.low) + " to " + shortest(d.high) + of);
                                 return join(parts);
                               },
                               [&](const WordChoice& d) { return join(d.words); }},
                    domain);
}

std::string OptionSchema::refusal(std::string_view text) const {
  std::vector<std::string> words;
  if (const auto* choice = std::get_if<WordChoice>(&domain)) words = choice->words;
  if (const auto* range = std::get_if<RealRange>(&domain)) words = range->words;
  std::string message = "'";
  return message.append(text) + "' is not allowed" + did_you_mean(text, words) + "; give " + allowed();
}

OptionValue OptionSchema::parse(std::string_view text) const {
  std::optional<OptionValue> value;
  const bool whole =
      std::holds_alternative<IntegerRange>(domain) || std::holds_alternative<IntegerChoice>(domain);
  if (whole) {
    if (const auto number = number_in<std::uint64_t>(text)) value = *number;
  } else if (std::holds_alternative<RealRange>(domain) && number_in<double>(text)) {
    value = *number_in<double>(text);
  } else {
    value = std::string(text);
  }
  if (!value || !allows(domain, *value)) throw UsageError("option " + name + ": " + refusal(text));
  return *value;
}

void OptionSchema::require_allowed(const OptionValue& value) const {
  if (!allows(domain, value)) throw UsageError("option " + name + ": " + refusal(to_text(value)));
}

bool operator==(const OptionSchema& a, const OptionSchema& b) {
  return a.name == b.name && a.allowed() == b.allowed() && a.usual == b.usual && a.unit == b.unit &&
         a.help == b.help;
}

OptionValues completed(const std::vector<OptionSchema>& schema, const OptionValues& values) {
  OptionValues out;
  for (const OptionSchema& option : schema) {
    const auto given = values.find(option.name);
    OptionValue value = given != values.end() ? given->second : option.usual;
    const auto* whole = std::get_if<std::uint64_t>(&value);
    if (whole && std::holds_alternative<RealRange>(option.domain)) value = static_cast<double>(*whole);
    option.require_allowed(value);
    out[option.name] = value;
  }
  return out;
}

void require_allowed(const std::vector<OptionSchema>& schema, std::string_view name,
                     const OptionValue& value) {
  std::find_if(schema.begin(), schema.end(), [&](const OptionSchema& option) {
    return option.name == name;
  })->require_allowed(value);
}

std::uint64_t integer_of(const OptionValues& values, std::string_view name) {
  return std::get<std::uint64_t>(values.find(name)->second);
}

double real_of(const OptionValues& values, std::string_view name) {
  return std::get<double>(values.find(name)->second);
}

const std::string& word_of(const OptionValues& values, std::string_view name) {
  return std::get<std::string>(values.find(name)->second);
}

}  // namespace penumbra
