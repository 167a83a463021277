#include "input.h"

#include <fmt/core.h>
#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "choices.h"
#include "errors.h"
#include "io/sites/density_place.h"
#include "members.h"
#include "runs.h"

namespace vorpipe::python {
namespace {

/// The GIL need not be held: the caller's reference keeps the points.
void takePoints(const Numbers& points, std::vector<double>& x, std::vector<double>& y) {
  const auto elements = points.unchecked<2>();
  const auto count = static_cast<std::size_t>(elements.shape(0));
  const WithoutGil no_gil;
  x.resize(count);
  y.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    x[i] = elements(row, 0);
    y[i] = elements(row, 1);
  }
}

void refuseNotFinite(const Sites& sites) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (std::isfinite(sites.x[i]) && std::isfinite(sites.y[i])) continue;
    raiseInput("points", fmt::format("point {} is not finite: {}, {}", i, sites.x[i], sites.y[i]));
  }
}

/// The points of a table, or of an array.
void takeSites(const GivenPoints& points, const std::optional<SystemArguments>& system,
               const DomainArguments& domain, Input& input) {
  if (const auto* const given = std::get_if<std::shared_ptr<Table>>(&points)) {
    const Table& table = **given;
    const bool fills_box = table.generator && domain.box;
    input.sites = fills_box ? sitesOf(*table.generator, boxFrom(*domain.box)) : table.sites;
    input.from = table.generator ? SitesFrom::generator : SitesFrom::file;
    input.system = table.system;
    input.attributes = table.attributes;
    if (table.of_caller) input.from = SitesFrom::caller;
    if (input.from == SitesFrom::file) input.files.push_back(table.name);
  } else {
    input.sites = sitesOf(std::get<Numbers>(points));
  }
  if (system) input.system = systemOf(*system);
}

void takeWeights(const GivenPoints& points, const std::optional<Numbers>& weights, Input& input) {
  if (!weights) return;
  if (!input.sites.weight.empty()) {
    const std::string& name = std::get<std::shared_ptr<Table>>(points)->name;
    raiseInput("weights", name + " has weights of its own");
  }
  input.sites.weight = vectorOf(*weights);
  if (input.sites.weight.size() != input.sites.size()) {
    raiseInput("weights", fmt::format("{} for the {} points of this domain", input.sites.weight.size(),
                                      input.sites.size()));
  }
}

DomainSettings settingsOf(const DomainArguments& arguments) {
  DomainSettings settings;
  settings.hull = arguments.hull;
  settings.repair = arguments.repair;
  if (arguments.margin) settings.margin = Margin{arguments.margin->first, arguments.margin->second};
  if (arguments.outline) {
    settings.outline = outlineOf(*arguments.outline);
    settings.outline_name = std::get<std::string>(*arguments.outline);
    const auto& system = std::get<std::optional<SystemArguments>>(*arguments.outline);
    if (system) settings.outline_system = systemOf(*system);
  } else if (arguments.box) {
    settings.box = boxFrom(*arguments.box);
  }
  if (arguments.project) {
    settings.project.emplace();
    if (arguments.center) settings.project->center = Point{(*arguments.center)[0], (*arguments.center)[1]};
  }
  settings.globe = arguments.globe;
  return settings;
}

/// The names that arguments of Python have.
DomainWords wordsOf(const GivenPoints& points) {
  DomainWords words;
  const auto* const table = std::get_if<std::shared_ptr<Table>>(&points);
  words.sites = table == nullptr ? "points" : (*table)->name;
  words.domain = "domain";
  words.box = "domain=(xmin, ymin, xmax, ymax)";
  words.project_amid = "project=\"auto\"";
  words.project_around = "project=(lon, lat)";
  words.density_box = "density_box=(xmin, ymin, xmax, ymax)";
  words.transform = "to_crs(\"{}\")";
  return words;
}

void checkDomain(const DomainArguments& arguments, const Input& input) {
  if (arguments.repair && !arguments.outline) raiseInput("repair", "is for an outline, and there is none");
  if (input.periodic != Periodic::none && input.from != SitesFrom::generator && !arguments.box) {
    raiseInput("domain", "a domain that repeats must be named: (xmin, ymin, xmax, ymax)");
  }
}

void takeDomain(const DomainArguments& arguments, const GivenPoints& points, Input& input) {
  checkDomain(arguments, input);
  const DomainSettings settings = settingsOf(arguments);
  auto found = [&] {
    const WithoutGil no_gil;
    return findDomain(settings, input, wordsOf(points));
  }();
  valueOf(std::move(found));
  if (!settings.outline_name.empty()) input.files.push_back(settings.outline_name);
}

/// The points as they were given.
py::array givenPoints(const Input& input) {
  Sites sites{input.projection ? input.longitudes : input.sites.x,
              input.projection ? input.latitudes : input.sites.y,
              {}};
  py::array array = pointsOf(sites);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace

Outline outlineOf(const OutlineArrays& arrays) {
  const auto& [points, rings, polygons, name, system] = arrays;
  const auto elements = points.unchecked<2>();
  Outline outline;
  outline.points.resize(static_cast<std::size_t>(elements.shape(0)));
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    outline.points[i] = {elements(row, 0), elements(row, 1)};
  }
  outline.ring_offsets = vectorOf(rings);
  outline.polygon_offsets = vectorOf(polygons);
  return outline;
}

Box boxFrom(const std::array<double, 4>& box) { return {box[0], box[1], box[2], box[3]}; }

Sites sitesOf(const Numbers& points) {
  Sites sites;
  takePoints(points, sites.x, sites.y);
  if (sites.size() == 0) raiseInput("points", "there are none");
  refuseNotFinite(sites);
  return sites;
}

Density densityOf(const DensityArguments& given) {
  const auto& [values, box, name, system] = given;
  const auto elements = values.unchecked<2>();
  Density density{static_cast<int>(elements.shape(1)), static_cast<int>(elements.shape(0)), {}};
  if (box) density.box = boxFrom(*box);
  density.values.reserve(static_cast<std::size_t>(values.size()));
  for (py::ssize_t row = 0; row < elements.shape(0); ++row) {
    for (py::ssize_t column = 0; column < elements.shape(1); ++column) {
      density.values.push_back(elements(row, column));
    }
  }
  return density;
}

static void takeDensity(const DensityArguments& given, const DomainWords& words, Input& input) {
  const auto& [values, box, name, system] = given;
  DensityFile density{densityOf(given)};
  if (system) density.system = systemOf(*system);
  valueOf(placeDensity(density, name, input, words));
  if (!name.empty()) input.files.push_back(name);
  input.density = std::move(density.density);
}

std::shared_ptr<Input> inputOf(const GivenPoints& points, const std::optional<Numbers>& weights,
                               const DomainArguments& domain, const std::string& periodic,
                               const std::optional<SystemArguments>& system) {
  auto input = std::make_shared<Input>();
  takeSites(points, system, domain, *input);
  takeWeights(points, weights, *input);
  input->periodic = chosen<Periodic>("periodic", periodic);
  takeDomain(domain, points, *input);
  return input;
}

/// The same without the points that are not kept; the domain stays.
static std::shared_ptr<Input> keptOf(const Input& input, const std::vector<bool>& kept) {
  auto less = std::make_shared<Input>(input);
  Attributes attributes;
  if (input.attributes) attributes = *input.attributes;
  keepSites(*less, attributes.columns, kept);
  if (input.attributes) less->attributes = std::make_shared<const Attributes>(std::move(attributes));
  return less;
}

void defineInput(py::module_& module) {
  py::class_<DomainArguments>(module, "Domain", "What a domain is asked for with.")
      .def(py::init([](const std::optional<std::array<double, 4>>& box, bool hull,
                       const std::optional<OutlineArrays>& outline,
                       const std::optional<std::pair<double, bool>>& margin, bool repair, bool project,
                       const std::optional<std::array<double, 2>>& center, bool globe) {
             return DomainArguments{box, hull, outline, margin, repair, project, center, globe};
           }),
           py::arg("box"), py::arg("hull"), py::arg("outline"), py::arg("margin"), py::arg("repair"),
           py::arg("project"), py::arg("center"), py::arg("globe"));
  // pybind11 holds no pointers to constants; nothing here changes one once it is made.
  py::class_<Input, std::shared_ptr<Input>>(module, "Input", "Points and where they have cells.")
      .def(py::init([](const GivenPoints& points, const std::optional<Numbers>& weights,
                       const DomainArguments& domain, const std::string& periodic,
                       const std::optional<DensityArguments>& density,
                       const std::shared_ptr<Attributes>& attributes,
                       const std::optional<SystemArguments>& system, bool free_surface) {
             auto input = inputOf(points, weights, domain, periodic, system);
             input->surface = free_surface ? Surface::free : Surface::none;
             if (density) takeDensity(*density, wordsOf(points), *input);
             if (attributes) input->attributes = attributes;
             return input;
           }),
           py::arg("points"), py::arg("weights"), py::arg("domain"), py::arg("periodic"), py::arg("density"),
           py::arg("attributes").none(true), py::arg("system"), py::arg("free_surface"))
      .def("__len__", [](const Input& input) { return input.sites.size(); })
      .def("kept", &keptOf, py::arg("kept"))
      .def_property_readonly("points", &givenPoints)
      // As cells stand around them: in a periodic domain all within it.
      .def_property_readonly("points_in_plane",
                             [](const Input& input) {
                               if (input.periodic == Periodic::none) return pointsOf(input.sites);
                               return pointsOf(valueOf(wrapped(input.sites, input.domain, input.periodic)));
                             })
      .def_property_readonly("globe", [](const Input& input) { return input.globe; })
      .def_property_readonly("free_surface",
                             [](const Input& input) { return input.surface == Surface::free; })
      .def_property_readonly("weights",
                             [](const std::shared_ptr<Input>& input) -> std::optional<py::array> {
                               if (input->sites.weight.empty()) return std::nullopt;
                               return viewOf<double>(input->sites.weight,
                                                     std::shared_ptr<const Input>(input));
                             })
      .def_property_readonly(
          "attributes",
          [](const Input& input) { return std::const_pointer_cast<Attributes>(input.attributes); })
      .def_property_readonly(
          "system",
          [](const Input& input) { return argumentsOf(input.projection ? input.degrees : input.system); })
      .def_property_readonly("notes", [](const Input& input) { return textsOf(input.notes); })
      .def_property_readonly("center",
                             [](const Input& input) -> std::optional<std::array<double, 2>> {
                               if (!input.projection) return std::nullopt;
                               const Point center = input.projection->center();
                               return std::array{center.x, center.y};
                             })
      .def_property_readonly("domain",
                             [](const Input& input) {
                               const Box& box = input.domain;
                               return std::array{box.xmin, box.ymin, box.xmax, box.ymax};
                             })
      .def_property_readonly("periodic", [](const Input& input) { return nameOf(input.periodic); })
      .def_property_readonly("has_outline", [](const Input& input) { return !input.outline.empty(); })
      .def_property_readonly("has_density", [](const Input& input) { return !input.density.values.empty(); })
      .def(pickles<Input>());
}

}  // namespace vorpipe::python
