/// Coordinate systems as Python has them.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "choices.h"
#include "io/base/coordinate_system.h"

namespace vorpipe {

template <>
inline constexpr std::array<std::string_view, 3> names_of<CoordinateKind>{"unknown", "degrees", "plane"};

}  // namespace vorpipe

namespace vorpipe::python {

/// The kind of coordinates, who gave the code, the code, the definition in WKT: vorpipe/_crs.py makes a name
/// of them.
using SystemArguments = std::tuple<std::string, std::string, std::int64_t, std::string>;

inline CoordinateSystem systemOf(const SystemArguments& arguments) {
  const auto& [kind, organization, code, definition] = arguments;
  return {chosen<CoordinateKind>("crs", kind), organization, code, definition, {}};
}

inline SystemArguments argumentsOf(const CoordinateSystem& system) {
  return {std::string(nameOf(system.kind)), system.organization, system.code, system.definition};
}

}  // namespace vorpipe::python
