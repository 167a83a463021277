#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "arrays.h"
#include "errors.h"
#include "io/domain/density_file.h"
#include "io/domain/outline_file.h"
#include "io/sites/site_source.h"
#include "io/sites/sites_file.h"
#include "io/sites/weights_file.h"
#include "results.h"

namespace vorpipe::python {
namespace {

py::array pointsOf(const Sites& sites) {
  std::vector<Point> points(sites.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {sites.x[i], sites.y[i]};
  return arrayOf<double>(std::move(points));
}

/// What `read` returns, which it finds without the GIL.
template <class Read>
auto readBy(Read read) {
  auto found = [&] {
    const py::gil_scoped_release no_gil;
    return read();
  }();
  return valueOf(std::move(found));
}

/// The points, and their weights where the file has them.
std::pair<py::array, std::optional<py::array>> sitesFrom(const std::string& path) {
  Sites sites = readBy([&] { return readSites(path, {.attributes = false}); }).sites;
  py::array points = pointsOf(sites);
  if (sites.weight.empty()) return {std::move(points), std::nullopt};
  return {std::move(points), arrayOf<double>(std::move(sites.weight))};
}

py::array generated(const std::string& pattern, const std::string& count, std::uint64_t seed) {
  // As the command line has it: one owner of the names.
  const SiteSource source = readBy([&] { return loadSites(pattern + ":" + count, seed); });
  if (!source.seed) raiseInput("pattern", "'" + pattern + "' is no generator");
  return pointsOf(source.table.sites);
}

py::tuple outlineFrom(const std::string& path) {
  Outline outline = readBy([&] { return readOutline(path); });
  return py::make_tuple(arrayOf<double>(std::move(outline.points)),
                        arrayOf<std::uint64_t>(std::move(outline.ring_offsets)),
                        arrayOf<std::uint64_t>(std::move(outline.polygon_offsets)));
}

py::array densityFrom(const std::string& path) {
  Density density = readBy([&] { return readDensity(path); });
  const py::array values = arrayOf<double>(std::move(density.values));
  return values.attr("reshape")(density.height, density.width).cast<py::array>();
}

py::array weightsFrom(const std::string& path, std::uint64_t count) {
  return arrayOf<double>(readBy([&] { return readWeights(path, count); }));
}

}  // namespace

void defineFiles(py::module_& module) {
  module.def("read_sites", &sitesFrom, py::arg("path"));
  module.def("read_weights", &weightsFrom, py::arg("path"), py::arg("count"));
  module.def("read_outline", &outlineFrom, py::arg("path"));
  module.def("read_density", &densityFrom, py::arg("path"));
  module.def("generate", &generated, py::arg("pattern"), py::arg("count"), py::arg("seed"));
  module.def(
      "random_weights",
      [](double low, double high, std::uint64_t count, std::uint64_t seed) {
        return arrayOf<double>(randomWeights(low, high, count, seed));
      },
      py::arg("low"), py::arg("high"), py::arg("count"), py::arg("seed"));
}

}  // namespace vorpipe::python
