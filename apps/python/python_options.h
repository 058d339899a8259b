// Methods and their options as Python names them: keyword arguments with underscores.
#pragma once

#include <pybind11/pybind11.h>

#include "penumbra/render/method.h"

namespace penumbra::python {

struct MethodChoice {
  std::string method;
  OptionValues options;
};

/// `method`: a name or None; without one `auto` where max_error is given, else the usual. Throws ValueError
/// for an option that the method has not, UsageError for a value outside of its domain.
MethodChoice choice_of(const pybind11::object& method, const pybind11::object& max_error,
                       const pybind11::kwargs& options);

/// {name: milliseconds}.
pybind11::dict dict_of(const StageTimes& times);
/// {name: value}.
pybind11::dict dict_of(const OptionValues& options);
pybind11::dict dict_of(const Counts& counts);
/// [{about, choice, reason, text, is_certificate}].
pybind11::list list_of(const std::vector<Decision>& decisions);

}  // namespace penumbra::python
