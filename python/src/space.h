/// Sites and cells in space.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "attributes.h"
#include "vorpipe.h"

namespace vorpipe::python {

/// Never changed after it was made.
struct SpaceSites {
  std::string name;  ///< the file, the generator or the argument, as messages have it
  Sites3 sites;
  std::vector<double> weights;  ///< as many, or none
  SharedAttributes attributes;
  bool generated = false;
  std::vector<std::string> notes{};
  std::optional<Box3> box{};  ///< that their file names
};

struct SpaceResult {
  std::shared_ptr<const SpaceSites> sites;
  Box3 domain;
  Detail3 detail;
  Diagram3 diagram;
  std::vector<double> weights;    ///< those of the sites, or others
  std::string periodic{};         ///< axes, as "xz"
  std::vector<double> lattice{};  ///< nine numbers, or none

  [[nodiscard]] Cells3Options options() const;
};

void defineSpace(pybind11::module_& module);

}  // namespace vorpipe::python
