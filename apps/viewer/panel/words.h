// Words for what the command line calls by short names.
#pragma once

#include <string>

#include "penumbra/render/method.h"

namespace penumbra::viewer {

/// "D-buffer" of "dbuffer". A method that is not known here: its name with a capital, hyphens as spaces.
std::string words_of_method(const std::string& name);
/// "Texture size" of "dbuffer-size"; in the same way for others.
std::string words_of_option(const std::string& name);

/// A value as a person reads it: "auto" for a 0 that stands for a choice of the method's own.
std::string shown_value(const OptionSchema& option, const std::string& value);
/// And back.
std::string value_from_shown(const OptionSchema& option, const std::string& shown);
/// What it decides, what is allowed and what is usual, in the same words.
std::string help_of(const OptionSchema& option);

/// "1,234,567"
std::string with_commas(std::size_t number);

}  // namespace penumbra::viewer
