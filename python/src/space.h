/// Sites and cells in space.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "attributes.h"
#include "vorpipe.h"

namespace vorpipe::python {

/// Never changed after it was made.
struct SpaceSites {
  std::string name;  ///< the file, the generator or the argument, as messages have it
  Sites3 sites;
  SharedAttributes attributes;
  bool generated = false;
  std::vector<std::string> notes{};
};

struct SpaceResult {
  std::shared_ptr<const SpaceSites> sites;
  Box3 domain;
  Detail3 detail;
  Diagram3 diagram;
};

void defineSpace(pybind11::module_& module);

}  // namespace vorpipe::python
