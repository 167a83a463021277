/// What runs bring: kept together with what they were about, so that it can be checked, compared and written.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input.h"
#include "io/cells/cells_file.h"
#include "io/pictures/picture_file.h"
#include "vorpipe.h"

namespace vorpipe::python {

/// Cells that a plane had, in degrees.
struct CellsInDegrees {
  PlacedSites placed;  ///< sites alone, and their system
  Diagram diagram;
};

struct CellsResult {
  std::shared_ptr<const Input> input;
  CellsOptions options;                        ///< without what only the run needed: the progress
  Diagram diagram;                             ///< as it was computed: in the plane of a projection
  std::optional<CellsInDegrees> in_degrees{};  ///< of a projection

  // As the caller has them.
  [[nodiscard]] const Diagram& shown() const { return in_degrees ? in_degrees->diagram : diagram; }
  [[nodiscard]] const Sites& sites() const { return in_degrees ? in_degrees->placed.sites : input->sites; }
  [[nodiscard]] const CoordinateSystem& system() const {
    return in_degrees ? in_degrees->placed.system : input->system;
  }
};

/// The result of a run; takes cells back to degrees if the input has a projection.
CellsResult resultOf(std::shared_ptr<const Input> input, CellsOptions options, Diagram diagram, int threads);

/// What the cells share, its vertices as the caller has them. Errors: those of topologyOf.
Result<Topology> topologyOf(const CellsResult& result, int threads);

struct PictureResult {
  std::shared_ptr<const Input> input;
  RenderOptions options;  ///< as above
  Rendering rendering;
};

struct RelaxResult {
  std::shared_ptr<const Input> input;  ///< as the sites were given
  Relaxed relaxed;
};

struct TransportResult {
  std::shared_ptr<const Input> input;  ///< as the sites were given
  Surface surface;
  Transported found;
};

/// Which masses cells are to have; by name what is chosen.
struct TransportArguments {
  std::vector<double> masses;  ///< empty: equal ones
  bool normalize;
  std::optional<double> fill;
  bool free_surface;
  TransportOptions options;  ///< of transport_rows
  std::string search;
  int neighbors;
};

/// Throws InputError for what contradicts itself, and for a name that there is not.
TransportOptions transportOptionsOf(const Input& input, const TransportArguments& given);

/// How sites are to move; by name what is chosen.
struct RelaxArguments {
  RelaxOptions options;  ///< of relax_rows
  std::string search;
  int neighbors;
};

/// Throws InputError for a name that there is not.
RelaxOptions relaxOptionsOf(const Input& input, const RelaxArguments& given);

/// The options that follow from the input.
CellsOptions cellsOptionsOf(const Input& input);

/// The format that the path's extension names. Throws InputError where there is none, it takes more detail
/// than the cells have, or it has no records to leave out, as `only_cells` wants.
const CellsFormat& formatOf(const CellsResult& result, const std::string& path, bool only_cells);

/// Throws InputError where these cells have less detail than `name` takes.
void requireDetail(const CellsResult& result, std::string_view name, Detail detail);

/// What a file of these cells is written from.
CellsOutput outputOf(const CellsResult& result, bool only_cells);

/// The format of shapes that the path's extension names. Throws InputError where there is none.
const PictureFormat& shapesFormatOf(const std::string& path);

void defineReport(py::module_& module);
void defineCells(py::module_& module);
/// Sites that move.
void defineRelaxing(py::module_& module);
/// Weights for masses that are prescribed.
void defineTransporting(py::module_& module);
/// What is found in cells once they are there.
void defineReading(py::module_& module);
void definePicture(py::module_& module);
/// check, and what compares two results.
void defineJudgment(py::module_& module);
void defineForecast(py::module_& module);
void defineDevices(py::module_& module);
void defineSelftest(py::module_& module);
/// How a picture is to look.
void defineLook(py::module_& module);
/// Weights, outlines and densities out of files.
void defineFiles(py::module_& module);
/// What vorpipe.compat makes of triangles.
void defineTriangles(py::module_& module);

}  // namespace vorpipe::python
