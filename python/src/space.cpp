#include "space.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "arrays.h"
#include "base/try.h"
#include "errors.h"
#include "io/cells/space_file.h"
#include "io/sites/space_source.h"
#include "members.h"
#include "saving.h"
#include "session.h"
#include "watch.h"

namespace vorpipe::python {

Cells3Options SpaceResult::options() const {
  Cells3Options options{domain, detail, {}, weights};
  const auto has = [this](char axis) { return periodic.find(axis) != std::string::npos; };
  options.periodic = {has('x'), has('y'), has('z')};
  if (const auto& v = lattice; !v.empty())
    options.lattice = Lattice{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
  return options;
}

namespace {

using SharedSites3 = std::shared_ptr<SpaceSites>;
using SharedCells3 = std::shared_ptr<SpaceResult>;
using BoxNumbers = std::tuple<double, double, double, double, double, double>;
/// Of shape (N, 3), without gaps.
using Positions = py::array_t<double, py::array::c_style>;
/// Of shape (N,).
using Weights = py::array_t<double, py::array::c_style | py::array::forcecast>;

BoxNumbers numbersOfBox(const Box3& box) {
  return {box.xmin, box.ymin, box.zmin, box.xmax, box.ymax, box.zmax};
}

Box3 boxOfNumbers(const BoxNumbers& numbers) {
  return std::apply([](auto... sides) { return Box3{sides...}; }, numbers);
}

SharedSites3 sitesFrom(SpaceTable table, std::string name, SharedAttributes attributes = nullptr) {
  if (!attributes) attributes = std::make_shared<const Attributes>(Attributes{std::move(table.attributes)});
  return std::make_shared<SpaceSites>(SpaceSites{std::move(name), std::move(table.sites),
                                                 std::move(table.weights), std::move(attributes),
                                                 table.generated, std::move(table.notes), table.box});
}

SharedSites3 sitesOfArray(const Positions& positions, const std::optional<BoxNumbers>& box,
                          const std::shared_ptr<Attributes>& attributes) {
  const auto* const first = reinterpret_cast<const Point3*>(positions.data());
  SpaceTable table;
  table.sites.assign(first, first + positions.shape(0));
  if (box) table.box = boxOfNumbers(*box);
  return sitesFrom(std::move(table), "points", attributes);
}

SharedSites3 readSpace(const std::string& spec, std::uint64_t seed, const std::string& format,
                       const std::vector<std::string>& columns, bool skip_missing,
                       const std::optional<BoxNumbers>& box) {
  ReadOptions options;
  options.format = format;
  options.columns = columns;
  options.skip_missing = skip_missing;
  const auto domain = box ? std::optional(boxOfNumbers(*box)) : std::nullopt;
  auto table = [&] {
    const WithoutGil no_gil;
    return loadSpaceSites(spec, seed, options, domain);
  }();
  return sitesFrom(valueOf(std::move(table)), spec);
}

SharedCells3 cellsInSpace(SharedSession& session, const SharedSites3& sites,
                          const std::optional<Weights>& weights, const std::optional<BoxNumbers>& domain,
                          const std::string& periodic, const std::vector<double>& lattice, bool measures,
                          const py::object& progress) {
  auto result = std::make_shared<SpaceResult>();
  result->sites = sites;
  result->weights = sites->weights;
  if (weights && !sites->weights.empty()) raiseInput("weights", sites->name + " has weights of its own");
  if (weights) result->weights.assign(weights->data(), weights->data() + weights->size());
  result->periodic = periodic;
  result->lattice = lattice;
  if (!periodic.empty() && !domain && !sites->generated)
    raiseInput("periodic", "name the period by domain: points do not say it");
  result->detail = measures ? Detail3::measures : Detail3::polyhedra;
  session.run(progress, [&result, domain](Session& at, const Progress& heard) -> Result<void> {
    const Sites3& places = result->sites->sites;
    if (places.empty())
      return tl::unexpected(Error{ErrorCode::input, "there are no sites", false, Subject::sites});
    result->domain = domain                     ? boxOfNumbers(*domain)
                     : result->sites->generated ? Box3{0, 0, 0, 1, 1, 1}
                     : result->sites->box       ? *result->sites->box
                                                : domainOf(places);
    Cells3Options options = result->options();
    options.progress = heard;
    VORPIPE_VAR(diagram, at.cells(places, options));
    result->diagram = std::move(diagram);
    return {};
  });
  return result;
}

std::vector<std::string> brokenInSpace(const SharedCells3& result, int threads) {
  return valueOf(watched<std::vector<std::string>>(py::none(), [result, threads](Watch&) {
    return check(result->sites->sites, result->options(), result->diagram, threads);
  }));
}

Cells3Diff diffInSpace(const SpaceResult& a, const SpaceResult& b) {
  if (a.sites->sites != b.sites->sites) raiseInput("b", "its points are not those of a");
  return valueOf(diffCells(a.diagram, b.diagram));
}

void saveSpace(const SpaceResult& result, const std::string& path, const std::string& voro_format) {
  const SpaceFormat& format = *valueOf(spaceFormatOf(path));
  if (!voro_format.empty() && format.extension != ".vol")
    raiseInput("voro_format", fmt::format("{} has no such lines; .vol has", format.extension));
  if (auto known = checkVoroFormat(voro_format); !voro_format.empty() && !known)
    raiseInput("voro_format", known.error());
  if (format.detail > result.detail && format.extension != ".npz") {
    raiseInput("detail",
               fmt::format("{} takes cells that were computed with detail='all'; these have 'measures'",
                           format.extension));
  }
  const SpaceOutput output{
      result.sites->sites, result.diagram, result.sites->attributes->columns, result.detail, 0,
      result.weights,      voro_format};
  saveFile(path, {result.sites->name}, [&](ByteSink& sink) { return writeSpaceCells(sink, output, format); });
}

/// The property that shows an array of the diagram.
template <class Number, class Row>
auto shownOf(std::vector<Row> Diagram3::*rows) {
  return [rows](const SharedCells3& result) {
    return viewOf<Number>(result->diagram.*rows, std::shared_ptr<const SpaceResult>(result));
  };
}

/// Shows weights, if there are some.
template <class Owner>
std::optional<py::array> shownWeights(const std::shared_ptr<Owner>& of) {
  if (of->weights.empty()) return std::nullopt;
  return viewOf<double>(of->weights, std::shared_ptr<const Owner>(of));
}

void defineSpaceCells(py::module_& module) {
  py::class_<SpaceResult, SharedCells3>(module, "SpaceCells", "The arrays of cells in space.")
      .def("__len__", [](const SpaceResult& result) { return result.diagram.size(); })
      .def_property_readonly(
          "sites",
          [](const SpaceResult& result) { return std::const_pointer_cast<SpaceSites>(result.sites); })
      .def_property_readonly("domain", [](const SpaceResult& result) { return numbersOfBox(result.domain); })
      .def_property_readonly("weights", &shownWeights<SpaceResult>)
      .def_property_readonly("periodic", [](const SpaceResult& result) { return result.periodic; })
      .def_property_readonly("lattice", [](const SpaceResult& result) { return result.lattice; })
      .def_property_readonly("neighbor_shifts", shownOf<std::int32_t>(&Diagram3::neighbor_shifts))
      .def_property_readonly("measures",
                             [](const SpaceResult& result) { return result.detail == Detail3::measures; })
      .def_property_readonly(
          "report",
          [](const SharedCells3& result) { return std::shared_ptr<Report>(result, &result->diagram.report); })
      .def_property_readonly("status", shownOf<std::uint8_t>(&Diagram3::status))
      .def_property_readonly("owner", shownOf<std::int32_t>(&Diagram3::owner))
      .def_property_readonly("volumes", shownOf<double>(&Diagram3::volume))
      .def_property_readonly("areas", shownOf<double>(&Diagram3::surface))
      .def_property_readonly("centroids", shownOf<double>(&Diagram3::centroid))
      .def_property_readonly("second_moments", shownOf<double>(&Diagram3::second_moments))
      .def_property_readonly("neighbor_offsets", shownOf<std::int64_t>(&Diagram3::face_offsets))
      .def_property_readonly("neighbors", shownOf<std::int64_t>(&Diagram3::neighbors))
      .def_property_readonly("face_areas", shownOf<double>(&Diagram3::face_areas))
      .def_property_readonly("face_vertex_offsets", shownOf<std::int64_t>(&Diagram3::face_vertex_offsets))
      .def_property_readonly("face_vertices", shownOf<std::int32_t>(&Diagram3::face_vertices))
      .def_property_readonly("vertices", shownOf<double>(&Diagram3::vertices))
      .def_property_readonly("vertex_site_offsets", shownOf<std::int64_t>(&Diagram3::vertex_site_offsets))
      .def_property_readonly("vertex_sites", shownOf<std::int64_t>(&Diagram3::vertex_sites))
      .def_property_readonly("flat", [](const SpaceResult& result) { return result.diagram.flat; })
      .def("volume_sum", [](const SpaceResult& result) { return volumeSum(result.diagram); })
      .def("check", &brokenInSpace, py::arg("threads"))
      .def("save", &saveSpace, py::arg("path"), py::arg("voro_format"))
      .def(pickles<SpaceResult>());
}

}  // namespace

void defineSpace(py::module_& module) {
  py::class_<SpaceSites, SharedSites3>(module, "SpaceSites",
                                       "Points in space, with what their file says of them.")
      .def("__len__", [](const SpaceSites& sites) { return sites.sites.size(); })
      .def_property_readonly("points",
                             [](const SharedSites3& sites) {
                               return viewOf<double>(sites->sites, std::shared_ptr<const SpaceSites>(sites));
                             })
      .def_property_readonly("weights", &shownWeights<SpaceSites>)
      .def_property_readonly(
          "attributes",
          [](const SpaceSites& sites) { return std::const_pointer_cast<Attributes>(sites.attributes); })
      .def_readonly("name", &SpaceSites::name)
      .def_readonly("generated", &SpaceSites::generated)
      .def_property_readonly("box",
                             [](const SpaceSites& sites) {
                               return sites.box ? std::optional(numbersOfBox(*sites.box)) : std::nullopt;
                             })
      .def_readonly("notes", &SpaceSites::notes)
      .def(pickles<SpaceSites>());
  defineSpaceCells(module);
  py::class_<Cells3Diff>(module, "SpaceDiff", "How two diagrams in space of the same points differ.")
      .def_property_readonly("agree", &Cells3Diff::agree)
      .def_readonly("equal", &Cells3Diff::equal)
      .def_readonly("statuses", &Cells3Diff::statuses)
      .def_readonly("neighbors", &Cells3Diff::neighbors)
      .def_readonly("volumes", &Cells3Diff::volumes)
      .def_readonly("first", &Cells3Diff::first);
  module.def("space_sites", &sitesOfArray, py::arg("positions"), py::arg("box"), py::arg("attributes"));
  module.def("read_space", &readSpace, py::arg("spec"), py::arg("seed"), py::arg("format"),
             py::arg("columns"), py::arg("skip_missing"), py::arg("box"));
  module.def("is_of_space", &isOfSpace, py::arg("spec"));
  module.def("cells_in_space", &cellsInSpace, py::arg("session"), py::arg("sites"), py::arg("weights"),
             py::arg("domain"), py::arg("periodic"), py::arg("lattice"), py::arg("measures"),
             py::arg("progress"));
  module.def("diff_space", &diffInSpace, py::arg("a"), py::arg("b"));
}

}  // namespace vorpipe::python
