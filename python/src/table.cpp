#include "table.h"

#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "arrays.h"
#include "errors.h"
#include "io/sites/site_source.h"
#include "runs.h"
#include "systems.h"

namespace vorpipe::python {
namespace {

using SharedTable = std::shared_ptr<Table>;

/// A message with Python's words for what the command line calls options.
std::string inPython(std::string message) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> words = {
      {{"--missing skip", "missing=\"skip\""}, {"--columns", "columns"}, {"--layer", "layer"}}};
  for (const auto& [option, argument] : words) {
    for (std::size_t at = 0; (at = message.find(option, at)) != std::string::npos; at += argument.size()) {
      message.replace(at, option.size(), argument);
    }
  }
  return message;
}

/// Reads or generates what `spec` names.
SharedTable tableFrom(const std::string& spec, std::uint64_t seed, const ReadOptions& options) {
  auto found = [&] {
    const WithoutGil no_gil;
    return loadSites(spec, seed, options);
  }();
  if (!found) found.error().message = inPython(std::move(found.error().message));
  SiteSource source = valueOf(std::move(found));
  SiteTable& table = source.table;
  for (std::string& note : table.notes) note = inPython(std::move(note));
  Attributes attributes{std::move(table.attributes)};
  return std::make_shared<Table>(Table{spec == "-" ? "<stdin>" : spec, std::move(table.sites),
                                       std::make_shared<const Attributes>(std::move(attributes)),
                                       std::move(table.system), source.seed.has_value(), table.skipped,
                                       std::move(table.notes)});
}

std::optional<py::array> weightsOf(const SharedTable& table) {
  if (table->sites.weight.empty()) return std::nullopt;
  return viewOf<double>(table->sites.weight, std::shared_ptr<const Table>(table));
}

}  // namespace

py::array pointsOf(const Sites& sites) {
  std::vector<Point> points(sites.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {sites.x[i], sites.y[i]};
  return arrayOf<double>(std::move(points));
}

void defineTable(py::module_& module) {
  py::class_<Table, SharedTable>(module, "Table", "Sites that were read or generated.")
      .def("__len__", [](const Table& table) { return table.sites.size(); })
      .def_property_readonly("name", [](const Table& table) { return textOf(table.name); })
      .def_readonly("generated", &Table::generated)
      .def_readonly("skipped", &Table::skipped)
      .def_property_readonly("notes", [](const Table& table) { return textsOf(table.notes); })
      .def_property_readonly("points", [](const Table& table) { return pointsOf(table.sites); })
      .def_property_readonly("weights", &weightsOf)
      .def_property_readonly(
          "attributes",
          [](const Table& table) { return std::const_pointer_cast<Attributes>(table.attributes); })
      .def_property_readonly("system", [](const Table& table) { return argumentsOf(table.system); });
  module.def(
      "read_table",
      [](const std::string& spec, std::uint64_t seed, const std::string& format,
         const std::vector<std::string>& columns, const std::string& layer, bool skip_missing,
         bool attributes) {
        return tableFrom(spec, seed, {format, columns, layer, skip_missing, attributes});
      },
      py::arg("spec"), py::arg("seed"), py::arg("format"), py::arg("columns"), py::arg("layer"),
      py::arg("skip_missing"), py::arg("attributes"));
}

}  // namespace vorpipe::python
