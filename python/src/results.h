/// What runs bring: kept together with what they were about, so that it can be checked, compared and written.
#pragma once

#include <memory>

#include "input.h"
#include "io/cells/cells_file.h"
#include "vorpipe.h"

namespace vorpipe::python {

struct CellsResult {
  std::shared_ptr<const Input> input;
  CellsOptions options;  ///< without what only the run needed: the progress
  Diagram diagram;
};

struct PictureResult {
  std::shared_ptr<const Input> input;
  RenderOptions options;  ///< as above
  Rendering rendering;
};

/// The options that follow from the input.
CellsOptions cellsOptionsOf(const Input& input);

/// The format that the path's extension names. Throws InputError where there is none, or it takes more detail
/// than the cells have.
const CellsFormat& formatOf(const CellsResult& result, const std::string& path);

void defineReport(py::module_& module);
void defineCells(py::module_& module);
/// What is found in cells once they are there.
void defineReading(py::module_& module);
void definePicture(py::module_& module);
/// check, and what compares two results.
void defineJudgment(py::module_& module);
void defineForecast(py::module_& module);
void defineDevices(py::module_& module);
void defineSelftest(py::module_& module);
/// Sites, outlines and densities out of files, and generators.
void defineFiles(py::module_& module);
/// What vorpipe.compat makes of triangles.
void defineTriangles(py::module_& module);

}  // namespace vorpipe::python
