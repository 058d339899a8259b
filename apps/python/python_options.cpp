#include "apps/python/python_options.h"

#include <algorithm>

#include "penumbra/mesh/error.h"

namespace penumbra::python {
namespace {

namespace py = pybind11;

constexpr const char* kMaxError = "max-error";

const OptionSchema& schema_of(const MethodInfo& info, const std::string& name) {
  const auto found = std::ranges::find(info.options, name, &OptionSchema::name);
  if (found != info.options.end()) return *found;
  std::string known;
  for (const OptionSchema& option : info.options) known += (known.empty() ? "" : ", ") + option.name;
  std::ranges::replace(known, '-', '_');
  throw py::value_error("method '" + info.name + "' has no option '" + name + "'; " +
                        (known.empty() ? "it has none" : "it has " + known));
}

template <class Value>
py::object python_value(const Value& value) {
  return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

std::string with_underscores(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace

MethodChoice choice_of(const py::object& method, const py::object& max_error, const py::kwargs& options) {
  MethodChoice out{!method.is_none()     ? std::string(py::str(method))
                   : max_error.is_none() ? kDefaultMethod
                                         : "auto",
                   {}};
  const MethodInfo& info = method_named(out.method);
  for (const auto& [key, value] : options) {
    std::string name = py::str(key);
    std::ranges::replace(name, '_', '-');
    out.options[name] = schema_of(info, name).parse(std::string(py::str(value)));
  }
  if (max_error.is_none()) return out;
  if (std::ranges::find(info.options, kMaxError, &OptionSchema::name) == info.options.end())
    throw py::value_error("max_error is for method 'auto', which chooses one that keeps it; method '" +
                          info.name + "' has options of its own: leave one of the two out");
  out.options[kMaxError] = schema_of(info, kMaxError).parse(std::string(py::str(max_error)));
  return out;
}

py::dict dict_of(const StageTimes& times) {
  py::dict out;
  for (const StageTime& time : times) out[py::str(time.name)] = time.milliseconds;
  return out;
}

py::dict dict_of(const OptionValues& options) {
  py::dict out;
  for (const auto& [name, value] : options) out[py::str(with_underscores(name))] = python_value(value);
  return out;
}

py::dict dict_of(const Counts& counts) {
  py::dict out;
  for (const Count& count : counts) out[py::str(count.name)] = python_value(count.value);
  return out;
}

py::list list_of(const std::vector<Decision>& decisions) {
  py::list out;
  for (const Decision& d : decisions) {
    py::dict entry;
    entry["about"] = d.about;
    entry["choice"] = d.choice;
    entry["reason"] = d.reason;
    entry["text"] = d.text;
    entry["is_certificate"] = d.is_certificate;
    out.append(entry);
  }
  return out;
}

}  // namespace penumbra::python
