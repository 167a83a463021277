#include "vorpipe/forecast.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "choices.h"
#include "errors.h"
#include "look.h"
#include "results.h"
#include "session.h"
#include "vorpipe/shapes.h"

namespace vorpipe::python {
namespace {

/// The arrays that Python's own arguments were copied to.
void planInput(MemoryPlan& plan, const Input& input) {
  constexpr std::uint64_t number = sizeof(double);
  const std::uint64_t columns = input.sites.weight.empty() ? 2 : 3;
  plan.take("points", columns * number * input.sites.size());
  if (!input.density.values.empty()) plan.take("density", 2 * number * input.density.values.size());
}

Workload workloadOf(const Input& input, ImagesFor purpose, SharedSession& session, int threads) {
  CellsOptions options{};
  options.domain = input.domain;
  options.outline = input.outline;
  options.density = input.density;
  options.periodic = input.periodic;
  return valueOf(vorpipe::workloadOf(input.sites, options, purpose, session.device(), threads));
}

using Parts = std::vector<std::pair<std::string, std::uint64_t>>;

/// Bytes at the peak, what they are, how many there are to have, and who sets that.
std::tuple<std::uint64_t, Parts, std::uint64_t, std::string> told(const MemoryPlan& plan) {
  Parts parts;
  for (const MemoryPart& part : plan.parts()) parts.emplace_back(part.what, part.bytes);
  const MemoryLimit limit = systemMemoryLimit();
  return {plan.peak(), std::move(parts), limit.bytes, limit.what};
}

auto forecastCells(SharedSession& session, const Input& input, const std::string& detail, bool checked,
                   int threads) {
  const Detail wanted = chosen<Detail>("detail", detail);
  const Workload work = workloadOf(input, ImagesFor::cells, session, threads);
  MemoryPlan plan;
  planInput(plan, input);
  planSession(plan, work);
  planCells(plan, work, wanted);
  if (checked) planCellsCheck(plan, work, wanted);
  return told(plan);
}

auto forecastPicture(SharedSession& session, const Input& input, const Look& look, bool checked,
                     int threads) {
  const RenderOptions wanted = renderOptionsOf(look, input);
  const Workload work = workloadOf(input, imagesFor(wanted), session, threads);
  MemoryPlan plan;
  planInput(plan, input);
  planSession(plan, work);
  planPicture(plan, work, wanted);
  if (checked) planPictureCheck(plan, work, wanted);
  return told(plan);
}

}  // namespace

void defineForecast(py::module_& module) {
  module.def("forecast_cells", &forecastCells, py::arg("session"), py::arg("input"), py::arg("detail"),
             py::arg("check"), py::arg("threads"));
  module.def("forecast_picture", &forecastPicture, py::arg("session"), py::arg("input"), py::arg("look"),
             py::arg("check"), py::arg("threads"));
}

}  // namespace vorpipe::python
