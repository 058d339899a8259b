#include "apps/cli/study/settings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr int kFewestPowers = -4, kMostPowers = 2;  // of 4
constexpr std::size_t kMostCombinations = 16;
constexpr std::size_t kQuickSteps = 3, kMostQuickCombinations = 8;

struct Steps {
  const OptionValue& usual;

  std::vector<OptionValue> operator()(const IntegerRange& range) const {
    std::vector<OptionValue> out;
    const auto middle = static_cast<double>(std::get<std::uint64_t>(usual));
    for (int power = kFewestPowers; power <= kMostPowers; ++power) {
      const double value = middle * std::pow(4.0, power);
      if (value == std::floor(value) && value >= static_cast<double>(range.low) &&
          value <= static_cast<double>(range.high))
        out.emplace_back(static_cast<std::uint64_t>(value));
    }
    return out;
  }
  std::vector<OptionValue> operator()(const IntegerChoice& choice) const {
    return {choice.values.begin(), choice.values.end()};
  }
  std::vector<OptionValue> operator()(const RealRange& range) const {
    std::vector<OptionValue> out(range.words.begin(), range.words.end());
    if (range.low == 0.0 && range.low_included) out.emplace_back(0.0);
    const auto* middle = std::get_if<double>(&usual);
    for (int power = kFewestPowers; middle && power <= kMostPowers; ++power) {
      const double value = *middle * std::pow(4.0, power);
      if (value > range.low && value <= range.high) out.emplace_back(value);
    }
    return out;
  }
  std::vector<OptionValue> operator()(const WordChoice& choice) const {
    return {choice.words.begin(), choice.words.end()};
  }
};

std::optional<Setting> draft_of(const MethodInfo& method, const Setting& usual) {
  Setting draft = usual;
  draft.varied = "draft";
  for (const OptionSchema& option : method.options)
    if (option.draft) draft.options[option.name] = *option.draft;
  return draft.options == usual.options ? std::nullopt : std::optional(draft);
}

/// An option and the values that are tried.
struct OptionSteps {
  std::string name;
  std::vector<OptionValue> values;
};

std::size_t combinations(const std::vector<OptionSteps>& steps) {
  std::size_t count = 1;
  for (const OptionSteps& option : steps) count *= option.values.size();
  return count;
}

std::vector<Setting> varied_alone(const Setting& usual, const std::vector<OptionSteps>& steps) {
  std::vector<Setting> out;
  for (const OptionSteps& option : steps)
    for (const OptionValue& value : option.values) {
      out.push_back(usual);
      out.back().varied = option.name;
      out.back().options[option.name] = value;
    }
  return out;
}

/// Whether a number is above its default: dear settings are varied alone.
bool is_dearer(const OptionValue& value, const OptionValue& usual) {
  const auto* a = std::get_if<std::uint64_t>(&value);
  const auto* b = std::get_if<std::uint64_t>(&usual);
  return a && b && *a > *b;
}

bool is_dearer(const Setting& setting, const Setting& usual) {
  return std::ranges::any_of(setting.options, [&](const auto& option) {
    return is_dearer(option.second, usual.options.at(option.first));
  });
}

std::vector<Setting> combined(const Setting& usual, const std::vector<OptionSteps>& steps) {
  std::vector<Setting> out{usual};
  for (const OptionSteps& option : steps) {
    std::vector<Setting> more;
    for (const Setting& before : out)
      for (const OptionValue& value : option.values) {
        more.push_back(before);
        if (value == usual.options.at(option.name)) continue;
        more.back().options[option.name] = value;
        more.back().varied = before.varied.empty() ? option.name : "several";
      }
    out = std::move(more);
  }
  std::erase_if(out, [&](const Setting& s) { return s.varied == "several" && is_dearer(s, usual); });
  return out;
}

}  // namespace

std::string Setting::label() const {
  std::string text = method;
  const auto add = [&text](const std::string& name, const OptionValue& value) {
    text += ", " + name + " " + penumbra::to_text(value);
  };
  const auto known = std::ranges::find(methods(), method, &MethodInfo::name);
  if (known == methods().end()) {
    for (const auto& [name, value] : options) add(name, value);
    return text;
  }
  for (const OptionSchema& option : known->options) {
    const auto value = options.find(option.name);
    if (value != options.end() && value->second != option.usual) add(option.name, value->second);
  }
  return text;
}

std::vector<OptionValue> steps_of(const OptionSchema& option) {
  return option.steps ? *option.steps : std::visit(Steps{option.usual}, option.domain);
}

std::vector<Setting> settings_of(const MethodInfo& method, bool quick) {
  std::vector<Setting> all{{.method = method.name, .options = completed(method.options, {})}};
  const Setting usual = all.front();
  const auto add = [&all](const std::vector<Setting>& more) {
    for (const Setting& setting : more)
      if (std::ranges::find(all, setting.options, &Setting::options) == all.end()) all.push_back(setting);
  };
  if (const auto draft = draft_of(method, usual)) add({*draft});
  std::vector<OptionSteps> steps;
  for (const OptionSchema& option : method.options) {
    const bool first = &option == &method.options.front();
    if (quick && !first && !std::holds_alternative<WordChoice>(option.domain)) continue;
    steps.push_back({option.name, steps_of(option)});
    if (quick && first) steps.back().values.resize(std::min(steps.back().values.size(), kQuickSteps));
    if (std::ranges::find(steps.back().values, option.usual) == steps.back().values.end())
      steps.back().values.push_back(option.usual);
  }
  const bool few = combinations(steps) <= (quick ? kMostQuickCombinations : kMostCombinations);
  if (quick && !few) steps.resize(1);
  add(few ? combined(usual, steps) : varied_alone(usual, steps));
  return all;
}

bool takes(const MethodInfo& method, const LightShape& light) {
  try {
    require_taken(method, light);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

}  // namespace penumbra::apps
