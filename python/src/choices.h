/// Values that are chosen by name.
#pragma once

#include <fmt/ranges.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/option_rows.h"
#include "errors.h"

namespace vorpipe::python {

namespace py = pybind11;

/// The value of that name, if it does not come before `first`; throws an InputError that lists the names.
template <Named Value>
Value chosen(std::string_view argument, const std::string& name, Value first = Value{}) {
  if (const auto value = valueNamed<Value>(name, first)) return *value;
  raiseInput(argument, fmt::format("'{}' is none of {}", name, fmt::join(namesFrom(first), ", ")));
}

/// The color that a text says; throws an InputError about the argument.
inline Color colorOf(std::string_view argument, const std::string& text) {
  auto color = readColor(text);
  if (!color) raiseInput(argument, color.error().message);
  return *color;
}

/// Replaces the options of these rows that `given` names.
template <class Rows, class Struct>
void takeOptions(const Rows& rows, const py::dict& given, Struct& options) {
  forEachRow(rows, [&](const auto& row) {
    auto& option = options.*row.member;
    using Value = std::decay_t<decltype(option)>;
    if (!given.contains(row.name)) return;
    const py::object value = given[row.name];
    if constexpr (Named<Value>) {
      option = chosen<Value>(row.name, value.cast<std::string>());
    } else if constexpr (std::is_same_v<Value, Point>) {
      const auto [x, y] = value.cast<std::pair<double, double>>();
      option = {x, y};
    } else if constexpr (std::is_same_v<Value, std::optional<Color>>) {
      if (!value.is_none()) option = colorOf(row.name, value.cast<std::string>());
    } else {
      option = value.cast<Value>();
    }
  });
}

/// The default of each of these options, in Python's types.
template <class Struct, class Rows>
py::dict usualOptions(const Rows& rows) {
  py::dict usual;
  forEachRow(rows, [&](const auto& row) {
    const auto value = Struct{}.*row.member;
    if constexpr (Named<std::decay_t<decltype(value)>>) {
      usual[row.name] = nameOf(value);
    } else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Point>) {
      usual[row.name] = std::pair(value.x, value.y);
    } else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::optional<Color>>) {
      usual[row.name] = py::none();
    } else {
      usual[row.name] = value;
    }
  });
  return usual;
}

}  // namespace vorpipe::python
