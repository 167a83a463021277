#include "flowing.h"

#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "base/try.h"
#include "choices.h"
#include "errors.h"
#include "io/base/extension.h"
#include "io/cells/fluid_state.h"
#include "io/cells/points_file.h"
#include "saving.h"

namespace vorpipe::python {
namespace {

using SharedFluid = std::shared_ptr<FluidRun>;

std::vector<Point> rowsOf(const Numbers& numbers) {
  const auto elements = numbers.unchecked<2>();
  std::vector<Point> rows(static_cast<std::size_t>(elements.shape(0)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    rows[i] = {elements(row, 0), elements(row, 1)};
  }
  return rows;
}

/// A fluid of an input; arrays are as long as its points, as vorpipe/_fluid.py has seen to.
FluidSetup setupOf(const Input& input, const std::optional<Numbers>& velocities,
                   const std::optional<Numbers>& volumes, const std::optional<Numbers>& densities) {
  FluidSetup setup{};
  setup.options.domain = input.domain;
  setup.options.outline = input.outline;
  setup.options.periodic = input.periodic;
  setup.options.surface = input.surface;
  setup.state.sites = input.sites;
  if (velocities) setup.state.velocity = rowsOf(*velocities);
  if (volumes) setup.state.volume = vectorOf(*volumes);
  if (densities) setup.state.density = vectorOf(*densities);
  return setup;
}

/// A case by its name, in an outline if there is one; or a file.
FluidSetup namedSetup(const std::string& name, std::uint64_t parcels,
                      const std::optional<OutlineArrays>& outline, bool repair) {
  const auto named = fluidCaseOf(name);
  if (named && outline) {
    auto setup =
        mended(outlineOf(*outline), repair).and_then([&](const MendedOutline& walls) -> Result<FluidSetup> {
          return fluidCase(*named, parcels, walls.outline);
        });
    if (!setup && setup.error().code == ErrorCode::input) raiseInput("domain", setup.error().message);
    return valueOf(std::move(setup));
  }
  if (named) return fluidCase(*named, parcels);
  if (lowerExtension(name) == ".npz") return valueOf(readFluid(name));
  std::string known;
  for (const std::string& one : fluidCaseNames()) known += one + ", ";
  raiseInput("begin", "'" + name + "' is none of " + known + "and no .npz file");
}

/// `given` has options by the names of fluid_rows.
void choose(FluidSetup& setup, const py::dict& given, std::optional<std::uint64_t> diagrams,
            const std::string& search, int neighbors) {
  FluidOptions& options = setup.options;
  takeOptions(fluid_rows, given, options);
  options.diagrams = diagrams.value_or(options.diagrams);
  options.search = {chosen<Search>("search", search), neighbors};
}

/// The property of a fluid that shows an array of its state, which stays as it was then.
template <class Number, class Row>
auto ofState(std::vector<Row> FluidState::*rows) {
  return [rows](const FluidRun& run) {
    const auto now = run.now();
    return viewOf<Number>(now->state.*rows, now);
  };
}

py::array placesOf(const FluidRun& run) {
  const auto now = run.now();
  const Sites& sites = now->state.sites;
  std::vector<Point> rows;
  for (std::size_t i = 0; i < sites.size(); ++i) rows.push_back({sites.x[i], sites.y[i]});
  py::array places = arrayOf<double>(std::move(rows));
  places.attr("setflags")(py::arg("write") = false);
  return places;
}

void saveFluid(const FluidRun& run, const std::string& path) {
  const auto now = run.now();
  if (lowerExtension(path) == ".npz") {
    saveFile(path, {}, [&](ByteSink& sink) { return writeFluid(sink, now->state, now->options); });
    return;
  }
  const PointsFormat& format = *valueOf(pointsFormatOf(path));
  saveFile(path, {}, [&](ByteSink& sink) { return writePoints(sink, {now->state.sites}, format); });
}

std::shared_ptr<Report> reportOf(const FluidRun& run) {
  const auto now = std::const_pointer_cast<FluidNow>(run.now());
  return {now, &now->report};
}

void defineFluidStep(py::module_& module) {
  py::class_<FluidStep>(module, "FluidStep", "What a step of a fluid has come to.")
      .def_readonly("step", &FluidStep::step)
      .def_readonly("time", &FluidStep::time)
      .def_readonly("length", &FluidStep::length)
      .def_readonly("kinetic", &FluidStep::kinetic)
      .def_readonly("potential", &FluidStep::potential)
      .def_readonly("spring", &FluidStep::spring)
      .def_property_readonly("energy", &FluidStep::energy)
      .def_property_readonly(
          "momentum", [](const FluidStep& step) { return std::pair(step.momentum.x, step.momentum.y); })
      .def_readonly("worst", &FluidStep::worst)
      .def_readonly("farthest", &FluidStep::farthest)
      .def_readonly("diagrams", &FluidStep::diagrams)
      .def_readonly("linear_iterations", &FluidStep::linear_iterations)
      .def_readonly("halvings", &FluidStep::halvings)
      .def_readonly("velocity_error", &FluidStep::velocity_error)
      .def_readonly("seconds", &FluidStep::seconds)
      .def("__repr__", [](const FluidStep& step) {
        return fmt::format("<vorpipe.FluidStep {}: time {:.6g}, energy {:.6g}, areas within {:.1e}>",
                           step.step, step.time, step.energy(), step.worst);
      });
}

void defineSetup(py::module_& module) {
  py::class_<FluidSetup>(module, "FluidSetup", "What a fluid begins with.")
      .def_static("of", &setupOf, py::arg("input"), py::arg("velocities"), py::arg("volumes"),
                  py::arg("densities"))
      .def_static("named", &namedSetup, py::arg("name"), py::arg("parcels"), py::arg("outline"),
                  py::arg("repair"))
      .def("choose", &choose, py::arg("options"), py::arg("diagrams"), py::arg("search"),
           py::arg("neighbors"));
  module.attr("FLUID") = usualOptions<FluidOptions>(fluid_rows);
}

}  // namespace

std::shared_ptr<const FluidNow> FluidRun::now() const {
  const std::lock_guard lock(mutex_);
  return now_;
}

void FluidRun::publish() {
  auto now = std::make_shared<const FluidNow>(
      FluidNow{fluid_->state(), fluid_->options(), fluid_->last(), fluid_->end(), fluid_->report()});
  const std::lock_guard lock(mutex_);
  now_ = std::move(now);
}

std::shared_ptr<FluidRun> FluidRun::begin(const std::shared_ptr<SharedSession>& session, FluidSetup setup,
                                          const py::object& progress) {
  std::shared_ptr<FluidRun> run(new FluidRun(session, setup.state.time));
  // The fluid is a part of the run, which outlives it.
  setup.options.progress = [self = run.get()](std::string_view, double) { return self->isTold(self->done_); };
  session->run(progress,
               [run, setup = std::move(setup)](Session& opened, const Progress& heard) -> Result<void> {
                 run->heard_ = &heard;
                 auto fluid = Fluid::begin(opened, setup.state, setup.options);
                 run->heard_ = nullptr;
                 if (!fluid) return tl::unexpected(std::move(fluid.error()));
                 run->fluid_ = std::move(*fluid);
                 run->publish();
                 return {};
               });
  return run;
}

bool FluidRun::step(const py::object& progress) {
  const auto made = std::make_shared<bool>(false);
  session_->run(progress, [self = shared_from_this(), made](Session&, const Progress& heard) -> Result<void> {
    Fluid& fluid = *self->fluid_;
    const double until = fluid.options().until;
    const bool ends = std::isfinite(until) && until > self->begin_;
    self->done_ = ends ? std::min(1.0, (fluid.last().time - self->begin_) / (until - self->begin_)) : 0;
    self->heard_ = &heard;
    Result<void> ready{};
    if (fluid.end() == FluidEnd::cancelled) ready = fluid.goOn(until);
    Result<bool> more = ready ? fluid.step() : Result<bool>(tl::unexpected(std::move(ready.error())));
    self->heard_ = nullptr;
    self->publish();
    if (!more) return tl::unexpected(std::move(more.error()));
    *made = *more;
    return {};
  });
  return *made;
}

void FluidRun::goOn(double until, const py::object& progress) {
  session_->run(progress, [self = shared_from_this(), until](Session&, const Progress& heard) {
    self->heard_ = &heard;
    auto on = self->fluid_->goOn(until);
    self->heard_ = nullptr;
    self->publish();
    return on;
  });
}

void FluidRun::push(std::vector<Point> velocities) {
  session_->run(py::none(),
                [self = shared_from_this(), velocities = std::move(velocities)](
                    Session&, const Progress&) -> Result<void> {
                  VORPIPE_TRY(self->fluid_->push(velocities));
                  self->publish();
                  return {};
                });
}

void defineFlowing(py::module_& module) {
  defineFluidStep(module);
  defineSetup(module);
  py::class_<FluidRun, SharedFluid>(module, "Fluid", "A fluid, step by step.")
      .def("__len__", [](const FluidRun& run) { return run.now()->state.sites.size(); })
      .def("step", &FluidRun::step, py::arg("progress"))
      .def("go_on", &FluidRun::goOn, py::arg("until"), py::arg("progress"))
      .def(
          "push", [](FluidRun& run, const Numbers& velocities) { run.push(rowsOf(velocities)); },
          py::arg("velocities"))
      .def_property_readonly("points", &placesOf)
      .def_property_readonly("weights",
                             [](const FluidRun& run) {
                               const auto now = run.now();
                               return viewOf<double>(now->state.sites.weight, now);
                             })
      .def_property_readonly("velocities", ofState<double>(&FluidState::velocity))
      .def_property_readonly("pressures", ofState<double>(&FluidState::pressure))
      .def_property_readonly("volumes", ofState<double>(&FluidState::volume))
      .def_property_readonly("densities", ofState<double>(&FluidState::density))
      .def_property_readonly("last", [](const FluidRun& run) { return run.now()->last; })
      .def_property_readonly("end",
                             [](const FluidRun& run) -> std::optional<std::string> {
                               const FluidEnd end = run.now()->end;
                               if (end == FluidEnd::none) return std::nullopt;
                               return std::string(nameOf(end));
                             })
      .def_property_readonly("until", [](const FluidRun& run) { return run.now()->options.until; })
      .def_property_readonly("scheme", [](const FluidRun& run) { return nameOf(run.now()->options.scheme); })
      .def_property_readonly("viscosity", [](const FluidRun& run) { return run.now()->options.viscosity; })
      .def_property_readonly("centering", [](const FluidRun& run) { return run.now()->options.centering; })
      .def_property_readonly("walls", [](const FluidRun& run) { return nameOf(run.now()->options.walls); })
      .def_property_readonly("outline",
                             [](const FluidRun& run) {
                               Outline outline = run.now()->options.outline;
                               return std::tuple(arrayOf<double>(std::move(outline.points)),
                                                 std::move(outline.ring_offsets),
                                                 std::move(outline.polygon_offsets));
                             })
      .def_property_readonly("periodic",
                             [](const FluidRun& run) { return nameOf(run.now()->options.periodic); })
      .def_property_readonly("free_surface",
                             [](const FluidRun& run) { return run.now()->options.surface == Surface::free; })
      .def_property_readonly("domain",
                             [](const FluidRun& run) {
                               const Box box = run.now()->options.domain;
                               return std::array{box.xmin, box.ymin, box.xmax, box.ymax};
                             })
      .def_property_readonly("report", &reportOf)
      .def("save", &saveFluid, py::arg("path"));
  module.def("begin_fluid", &FluidRun::begin, py::arg("session"), py::arg("setup"), py::arg("progress"));
  module.def("fluid_cases", &fluidCaseNames);
  module.def("usual_particles", [](const std::string& name) {
    return usualParcels(fluidCaseOf(name).value_or(FluidCase::taylor_green));
  });
}

}  // namespace vorpipe::python
