#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "arrays.h"
#include "errors.h"
#include "results.h"
#include "watch.h"

namespace vorpipe::python {
namespace {

using Lines = std::vector<std::string>;

void refuseAir(const Input& input) {
  if (input.surface == Surface::free) raiseInput("check", "of a free surface nothing is verified yet");
}

/// Verifying knows no progress: Ctrl-C leaves it to itself.
Lines brokenInCells(const std::shared_ptr<CellsResult>& result, int threads) {
  refuseAir(*result->input);
  return valueOf(watched<Lines>(py::none(), [result, threads](Watch&) {
    return check(result->input->sites, result->options, result->diagram, threads);
  }));
}

Lines brokenInPicture(const std::shared_ptr<PictureResult>& result, int threads) {
  refuseAir(*result->input);
  return valueOf(watched<Lines>(py::none(), [result, threads](Watch&) {
    return check(result->input->sites, result->options, result->rendering, threads);
  }));
}

/// Two results can be told apart only where they are of the same sites.
void refuseOthers(const Input& a, const Input& b) {
  if (&a == &b) return;
  if (a.sites.x != b.sites.x || a.sites.y != b.sites.y || a.sites.weight != b.sites.weight) {
    raiseInput("b", "its points or weights are not those of a");
  }
}

CellsDiff diffOfCells(const CellsResult& a, const CellsResult& b) {
  refuseOthers(*a.input, *b.input);
  return valueOf(diffCells(a.diagram, b.diagram));
}

std::shared_ptr<IdDiff> diffOfPictures(const PictureResult& a, const PictureResult& b) {
  refuseOthers(*a.input, *b.input);
  const Image &first = a.rendering.image, &second = b.rendering.image;
  if (first.width != second.width || first.height != second.height) {
    raiseInput("b", "it has another size than a");
  }
  if (a.options.fit != b.options.fit)
    raiseInput("b", "its domain fits into it in another way than that of a");
  const Input& input = *a.input;
  auto diff = diffIds(first.ids, second.ids, first.width, first.height, input.sites, input.domain,
                      input.periodic, a.options.fit);
  return std::make_shared<IdDiff>(valueOf(std::move(diff)));
}

void defineCellsDiff(py::module_& module) {
  py::class_<CellDifference>(module, "CellDifference", "One site whose cells differ.")
      .def_readonly("site", &CellDifference::site)
      .def_readonly("status", &CellDifference::status)
      .def_readonly("neighbors", &CellDifference::neighbors)
      .def_readonly("area", &CellDifference::area)
      .def_readonly("area_a", &CellDifference::area_a)
      .def_readonly("area_b", &CellDifference::area_b);
  py::class_<CellsDiff>(module, "CellsDiff", "How two diagrams of the same points differ.")
      .def_property_readonly("agree", &CellsDiff::agree)
      .def_readonly("equal", &CellsDiff::equal)
      .def_readonly("statuses", &CellsDiff::statuses)
      .def_readonly("neighbors", &CellsDiff::neighbors)
      .def_readonly("areas", &CellsDiff::areas)
      .def_readonly("worst_site", &CellsDiff::worst_site)
      .def_readonly("worst_area", &CellsDiff::worst_area)
      .def_readonly("first", &CellsDiff::first);
}

void defineIdDiff(py::module_& module) {
  py::class_<IdDifference>(module, "IdDifference", "One pixel that belongs to different sites.")
      .def_readonly("row", &IdDifference::row)
      .def_readonly("column", &IdDifference::column)
      .def_readonly("a", &IdDifference::a)
      .def_readonly("b", &IdDifference::b)
      .def_readonly("distance", &IdDifference::distance);
  py::class_<IdDiff, std::shared_ptr<IdDiff>>(module, "IdDiff", "How two pictures of the same points differ.")
      .def_property_readonly("agree", &IdDiff::agree)
      .def_readonly("equal", &IdDiff::equal)
      .def_readonly("ties", &IdDiff::ties)
      .def_readonly("wrong", &IdDiff::wrong)
      .def_readonly("ties_allowed", &IdDiff::ties_allowed)
      .def_readonly("widest_tie", &IdDiff::widest_tie)
      .def_readonly("first", &IdDiff::first)
      .def_property_readonly("pixels", [](const std::shared_ptr<IdDiff>& diff) {
        return viewOf<std::uint8_t>(diff->pixels, std::shared_ptr<const IdDiff>(diff));
      });
}

}  // namespace

void defineJudgment(py::module_& module) {
  defineCellsDiff(module);
  defineIdDiff(module);
  module.def("check_cells", &brokenInCells, py::arg("cells"), py::arg("threads"));
  module.def("check_picture", &brokenInPicture, py::arg("picture"), py::arg("threads"));
  module.def("diff_cells", &diffOfCells, py::arg("a"), py::arg("b"));
  module.def("diff_pictures", &diffOfPictures, py::arg("a"), py::arg("b"));
}

}  // namespace vorpipe::python
