#include <fmt/core.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "arrays.h"
#include "errors.h"
#include "input.h"
#include "io/sites/density_file.h"
#include "io/sites/outline_file.h"
#include "io/sites/sites_file.h"
#include "io/sites/weights_file.h"
#include "results.h"
#include "runs.h"
#include "systems.h"

namespace vorpipe::python {
namespace {

/// What `read` returns, which it finds without the GIL.
template <class Read>
auto readBy(Read read) {
  auto found = [&] {
    const WithoutGil no_gil;
    return read();
  }();
  return valueOf(std::move(found));
}

py::tuple outlineFrom(const std::string& path, const std::string& layer) {
  auto read = readBy([&] { return readOutline(path, layer); });
  Outline& outline = read.outline;
  return py::make_tuple(
      arrayOf<double>(std::move(outline.points)), arrayOf<std::uint64_t>(std::move(outline.ring_offsets)),
      arrayOf<std::uint64_t>(std::move(outline.polygon_offsets)), py::bytes(path), argumentsOf(read.system));
}

py::tuple densityFrom(const std::string& path, std::optional<std::array<double, 4>> box) {
  const auto place = box ? std::optional(boxFrom(*box)) : std::nullopt;
  auto [density, system] = readBy([&] { return readDensity(path, place); });
  const py::array values = arrayOf<double>(std::move(density.values));
  if (density.box) box = {density.box->xmin, density.box->ymin, density.box->xmax, density.box->ymax};
  return py::make_tuple(values.attr("reshape")(density.height, density.width), box, py::bytes(path),
                        argumentsOf(system));
}

py::array weightsFrom(const std::string& path, std::uint64_t count) {
  return arrayOf<double>(readBy([&] { return readWeights(path, count); }));
}

}  // namespace

void defineFiles(py::module_& module) {
  module.def("read_weights", &weightsFrom, py::arg("path"), py::arg("count"));
  module.def("read_outline", &outlineFrom, py::arg("path"), py::arg("layer"));
  module.def("read_density", &densityFrom, py::arg("path"), py::arg("box"));
  module.def(
      "random_weights",
      [](double low, double high, std::uint64_t count, std::uint64_t seed) {
        if (!std::isfinite(high - low) || low > high) {
          raiseInput("low", fmt::format("no weights are from {} to {}", low, high));
        }
        if (count > max_sites) raiseInput("n", fmt::format("{} weights of at most {}", count, max_sites));
        return arrayOf<double>(randomWeights(low, high, count, seed));
      },
      py::arg("low"), py::arg("high"), py::arg("count"), py::arg("seed"));
}

}  // namespace vorpipe::python
