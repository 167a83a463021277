/// Values that are chosen by name.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "errors.h"
#include "vorpipe.h"

namespace vorpipe::python {

template <class Value, std::size_t count>
using Choices = std::array<std::pair<std::string_view, Value>, count>;

inline constexpr Choices<Periodic, 4> periodic_choices = {
    {{"none", Periodic::none}, {"x", Periodic::x}, {"y", Periodic::y}, {"xy", Periodic::xy}}};
inline constexpr Choices<Detail, 3> detail_choices = {
    {{"measures", Detail::measures}, {"polygons", Detail::polygons}, {"everything", Detail::everything}}};
inline constexpr Choices<ColorBy, 4> color_choices = {{{"site", ColorBy::site},
                                                       {"area", ColorBy::area},
                                                       {"neighbors", ColorBy::neighbors},
                                                       {"weight", ColorBy::weight}}};
inline constexpr Choices<ColorScale, 3> scale_choices = {
    {{"linear", ColorScale::linear}, {"log", ColorScale::log}, {"quantile", ColorScale::quantile}}};
inline constexpr Choices<Fit, 2> fit_choices = {{{"stretch", Fit::stretch}, {"letterbox", Fit::letterbox}}};
inline constexpr Choices<Search, 2> search_choices = {{{"grid", Search::grid}, {"flann", Search::flann}}};

/// The value of that name; throws an InputError that lists the names.
template <class Value, std::size_t count>
Value chosen(std::string_view argument, const Choices<Value, count>& choices, const std::string& name) {
  std::string known;
  for (const auto& [choice, value] : choices) {
    if (choice == name) return value;
    known += known.empty() ? "" : ", ";
    known += choice;
  }
  raiseInput(argument, "'" + name + "' is none of " + known);
}

/// Its name.
template <class Value, std::size_t count>
std::string_view nameIn(const Choices<Value, count>& choices, Value value) {
  for (const auto& [name, choice] : choices) {
    if (choice == value) return name;
  }
  return {};
}

}  // namespace vorpipe::python
