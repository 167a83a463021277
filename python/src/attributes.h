/// Attributes of points as arrays of NumPy.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "io/base/attribute.h"

namespace vorpipe::python {

/// Never changed once an input has it.
struct Attributes {
  std::vector<Attribute> columns;
};
using SharedAttributes = std::shared_ptr<const Attributes>;

void defineAttributes(pybind11::module_& module);

}  // namespace vorpipe::python
