/// Values that are chosen by name.
#pragma once

#include <fmt/ranges.h>

#include <string>
#include <string_view>

#include "base/option_names.h"
#include "errors.h"

namespace vorpipe::python {

/// The value of that name, if it does not come before `first`; throws an InputError that lists the names.
template <Named Value>
Value chosen(std::string_view argument, const std::string& name, Value first = Value{}) {
  if (const auto value = valueNamed<Value>(name, first)) return *value;
  raiseInput(argument, fmt::format("'{}' is none of {}", name, fmt::join(namesFrom(first), ", ")));
}

}  // namespace vorpipe::python
