#include "table.h"

#include <fmt/core.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "errors.h"
#include "input.h"
#include "io/sites/site_columns.h"
#include "io/sites/site_domain.h"
#include "io/sites/site_source.h"
#include "members.h"
#include "runs.h"
#include "systems.h"

namespace vorpipe::python {
namespace {

using SharedTable = std::shared_ptr<Table>;

using Words = std::span<const std::pair<std::string_view, std::string_view>>;

/// What arguments of Python are called where the command line has options.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> words_of_files = {
    {{"--missing skip", "missing=\"skip\""}, {"--columns", "columns"}, {"--layer", "layer"}}};

/// And of a table that is no file.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> words_of_tables = {
    {{"the header", "the table"},
     {"; the first line must name the columns, as in \"x,y\", or --columns says which they are",
      ", nor another usual name; give an array of the two columns that are meant"},
     {"--columns says which", "give an array of the two columns that are meant"},
     {"; --columns names others", ""}}};

std::string inWords(std::string message, Words words) {
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
  if (!found) found.error().message = inWords(std::move(found.error().message), words_of_files);
  SiteSource source = valueOf(std::move(found));
  SiteTable& table = source.table;
  for (std::string& note : table.notes) note = inWords(std::move(note), words_of_files);
  Attributes attributes{std::move(table.attributes)};
  return std::make_shared<Table>(Table{spec == "-" ? "<stdin>" : spec, std::move(table.sites),
                                       std::make_shared<const Attributes>(std::move(attributes)),
                                       std::move(table.system), source.generator, table.skipped,
                                       std::move(table.notes)});
}

/// Which columns of a table hold x, y, geometries and weights; whether those are radii; the kind of
/// coordinates; what was reinterpreted.
using NamedColumns =
    std::tuple<std::optional<std::size_t>, std::optional<std::size_t>, std::optional<std::size_t>,
               std::optional<std::size_t>, bool, std::string, std::string>;

/// None where no name says anything.
std::optional<NamedColumns> columnsNamed(const std::vector<std::string>& names) {
  if (!anyKnownColumn(names)) return std::nullopt;
  const auto found = namedColumns(names, {});
  if (!found) raiseInput("points", inWords(found.error().what, words_of_tables));
  return NamedColumns{found->x,
                      found->y,
                      found->geometry,
                      found->weight,
                      found->weight_kind == WeightKind::radius,
                      std::string(nameOf(found->kind)),
                      inWords(found->note, words_of_tables)};
}

/// What two coordinate systems are called, where they are not one.
std::optional<std::pair<std::string, std::string>> differingSystems(const SystemArguments& a,
                                                                    const SystemArguments& b) {
  const CoordinateSystem first = systemOf(a), second = systemOf(b);
  if (compared(first, second) != SystemsAre::different) return std::nullopt;
  return std::pair(nameOf(first), nameOf(second));
}

std::vector<double> weightsFrom(const Numbers& given, bool are_radii) {
  std::vector<double> weights = vectorOf(given);
  for (std::size_t i = 0; are_radii && i < weights.size(); ++i) {
    const auto weight = weightOf(WeightKind::radius, weights[i], fmt::format("{}", weights[i]));
    if (!weight) raiseInput("points", fmt::format("the radius of point {}: {}", i, weight.error()));
    weights[i] = *weight;
  }
  return weights;
}

/// A table that a program has: points (N, 2), weights (N,) and attributes.
SharedTable tableOf(const Numbers& points, const std::optional<Numbers>& weights, bool are_radii,
                    const std::shared_ptr<Attributes>& attributes,
                    const std::optional<SystemArguments>& system, std::vector<std::string> notes) {
  auto table = std::make_shared<Table>(Table{"points", sitesOf(points), attributes});
  table->notes = std::move(notes);
  table->of_caller = true;
  if (weights) table->sites.weight = weightsFrom(*weights, are_radii);
  if (system) table->system = systemOf(*system);
  if (const auto what = settleDegrees(table->sites, table->system); !what.empty()) {
    table->notes.push_back("points: " + std::string(what));
  }
  return table;
}

std::optional<py::array> weightsOf(const SharedTable& table) {
  if (table->sites.weight.empty()) return std::nullopt;
  return viewOf<double>(table->sites.weight, std::shared_ptr<const Table>(table));
}

}  // namespace

std::vector<Point> pointsIn(const Sites& sites) {
  std::vector<Point> points(sites.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {sites.x[i], sites.y[i]};
  return points;
}

py::array pointsOf(const Sites& sites) { return arrayOf<double>(pointsIn(sites)); }

void defineTable(py::module_& module) {
  py::class_<Table, SharedTable>(module, "Table", "Sites with all that is said of them.")
      .def(py::init(&tableOf), py::arg("points"), py::arg("weights"), py::arg("are_radii"),
           py::arg("attributes"), py::arg("system"), py::arg("notes"))
      .def("__len__", [](const Table& table) { return table.sites.size(); })
      .def_property_readonly("name", [](const Table& table) { return textOf(table.name); })
      .def_property_readonly("generated", [](const Table& table) { return table.generator.has_value(); })
      .def(
          "points_in",
          [](const Table& table, const std::array<double, 4>& box) {
            return pointsOf(sitesOf(table.generator.value(), Box{box[0], box[1], box[2], box[3]}));
          },
          py::arg("box"))
      .def_readonly("skipped", &Table::skipped)
      .def_property_readonly("notes", [](const Table& table) { return textsOf(table.notes); })
      .def_property_readonly("points", [](const Table& table) { return pointsOf(table.sites); })
      .def_property_readonly("weights", &weightsOf)
      .def_property_readonly(
          "attributes",
          [](const Table& table) { return std::const_pointer_cast<Attributes>(table.attributes); })
      .def_property_readonly("system", [](const Table& table) { return argumentsOf(table.system); })
      .def(pickles<Table>());
  module.def("differing_systems", &differingSystems, py::arg("a"), py::arg("b"));
  module.def("columns_named", &columnsNamed, py::arg("names"));
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
