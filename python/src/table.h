/// Sites with all that is said of them.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "attributes.h"
#include "io/base/coordinate_system.h"
#include "io/sites/site_source.h"
#include "vorpipe.h"

namespace vorpipe::python {

/// Never changed after it was made: inputs copy the numbers and share the attributes.
struct Table {
  std::string name;  ///< the file, the generator or the argument, as messages have it
  Sites sites;
  SharedAttributes attributes;
  CoordinateSystem system{};
  std::optional<Generator> generator{};  ///< none of a file
  std::uint64_t skipped = 0;             ///< rows that were left out
  std::vector<std::string> notes{};
  bool of_caller = false;  ///< a program has it; else it was read
};

std::vector<Point> pointsIn(const Sites& sites);

/// (N, 2), a copy.
pybind11::array pointsOf(const Sites& sites);

void defineTable(pybind11::module_& module);

}  // namespace vorpipe::python
