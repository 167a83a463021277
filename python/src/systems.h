/// Coordinate systems as Python has them.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "choices.h"
#include "io/base/coordinate_system.h"

namespace vorpipe::python {

inline constexpr Choices<CoordinateKind, 3> kind_choices = {{{"unknown", CoordinateKind::unknown},
                                                             {"degrees", CoordinateKind::degrees},
                                                             {"plane", CoordinateKind::plane}}};

/// The kind of coordinates, who gave the code, the code, the definition in WKT: vorpipe/_crs.py makes a name
/// of them.
using SystemArguments = std::tuple<std::string, std::string, std::int64_t, std::string>;

inline CoordinateSystem systemOf(const SystemArguments& arguments) {
  const auto& [kind, organization, code, definition] = arguments;
  return {chosen("crs", kind_choices, kind), organization, code, definition, {}};
}

inline SystemArguments argumentsOf(const CoordinateSystem& system) {
  return {std::string(nameIn(kind_choices, system.kind)), system.organization, system.code,
          system.definition};
}

}  // namespace vorpipe::python
