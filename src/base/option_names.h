/// Names of the values of enumerations, as options, arguments, files and messages have them. A name that is
/// added here is known to the command line, Python, files and the window.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe/fluid.h"
#include "vorpipe/picture.h"
#include "vorpipe/relax.h"
#include "vorpipe/transport.h"

namespace vorpipe {

/// In the order of the enumeration; none for other types.
template <class Enum>
inline constexpr std::array<std::string_view, 0> names_of{};

template <>
inline constexpr std::array<std::string_view, 4> names_of<Periodic>{"none", "x", "y", "xy"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<Surface>{"none", "free"};
template <>
inline constexpr std::array<std::string_view, 3> names_of<Detail>{"measures", "polygons", "all"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<Search>{"grid", "flann"};
template <>
inline constexpr std::array<std::string_view, 5> names_of<ColorBy>{
    "site", "area", "neighbors", "weight", "distinct"};  // ColorBy::value has the name of its values
template <>
inline constexpr std::array<std::string_view, 4> names_of<ColorScale>{"automatic", "linear", "log",
                                                                      "quantile"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<Fit>{"stretch", "letterbox"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<GlobeMap>{"plate-carree", "equal-earth"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<RelaxMethod>{"lbfgs", "lloyd"};
template <>
inline constexpr std::array<std::string_view, 4> names_of<RelaxEnd>{"iterations", "tolerance", "stagnated",
                                                                    "cancelled"};
template <>
inline constexpr std::array<std::string_view, 4> names_of<TransportEnd>{"converged", "stagnated", "diagrams",
                                                                        "cancelled"};
template <>
inline constexpr std::array<std::string_view, 3> names_of<FluidScheme>{"springs", "projection", "auto"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<FluidWalls>{"slip", "no-slip"};
template <>
inline constexpr std::array<std::string_view, 4> names_of<FluidEnd>{"none", "time", "areas", "cancelled"};

template <class Enum>
concept Named = names_of<Enum>
.size() > 0;

template <Named Enum>
constexpr std::string_view nameOf(Enum value) {
  return names_of<Enum>[static_cast<std::size_t>(value)];
}

/// Returns the names from that of `first` on: what comes before it is not offered.
template <Named Enum>
std::vector<std::string> namesFrom(Enum first = Enum{}) {
  return {names_of<Enum>.begin() + static_cast<std::ptrdiff_t>(first), names_of<Enum>.end()};
}

/// Returns the value of that name; none before `first`.
template <Named Enum>
constexpr std::optional<Enum> valueNamed(std::string_view name, Enum first = Enum{}) {
  const auto found =
      std::find(names_of<Enum>.begin() + static_cast<std::ptrdiff_t>(first), names_of<Enum>.end(), name);
  if (found == names_of<Enum>.end()) return std::nullopt;
  return static_cast<Enum>(found - names_of<Enum>.begin());
}

}  // namespace vorpipe
