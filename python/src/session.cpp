#include "session.h"
#include "base/try.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>
#include <vector>

#include "choices.h"
#include "errors.h"
#include "session_options.h"
#include "vorpipe/free_surface.h"
#include "vorpipe/masses.h"

namespace vorpipe::python {
namespace {

[[noreturn]] void raiseDevice(const char* message) { raise({ErrorCode::device, message}); }

/// The sessions that this thread waits for; more than one where a progress function uses another.
thread_local std::vector<const SharedSession*> waiting;

struct Waiting {
  explicit Waiting(const SharedSession* session) { waiting.push_back(session); }
  ~Waiting() { waiting.pop_back(); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
};

}  // namespace

SharedSession::SharedSession(const BackendOptions& options) : threads_(options.threads) {
  auto opened = [&] {
    const WithoutGil no_gil;
    return Session::open(options);
  }();
  session_ = std::make_unique<Session>(valueOf(std::move(opened)));
}

SharedSession::~SharedSession() {
  // Threads and devices stayed with the process that opened them: nothing of them can be ended here.
  if (getpid() != process_) static_cast<void>(session_.release());
}

void SharedSession::refuseOtherUse() const {
  if (getpid() != process_) {
    raiseDevice("the session belongs to the process that opened it: open another one in this process");
  }
  if (std::ranges::find(waiting, this) != waiting.end()) {
    raiseDevice("the session is busy with the run whose progress function this is");
  }
}

template <class T>
T SharedSession::use(const py::object& progress, std::function<Result<T>(Session&, const Progress&)> work) {
  refuseOtherUse();
  std::function<Result<T>(Watch&)> run = [self = shared_from_this(),
                                          work = std::move(work)](Watch& watch) -> Result<T> {
    const std::lock_guard lock(self->mutex_);
    if (!self->session_) return tl::unexpected(Error{ErrorCode::device, "the session is closed"});
    return work(*self->session_, progressOf(watch));
  };
  const Waiting here(this);
  return valueOf(watched<T>(progress, std::move(run)));
}

std::shared_ptr<CellsResult> SharedSession::find(const std::shared_ptr<const Input>& input,
                                                 CellsOptions options, const py::object& progress) {
  return use<std::shared_ptr<CellsResult>>(
      progress,
      [input, options = std::move(options), threads = threads_](
          Session& session, const Progress& heard) mutable -> Result<std::shared_ptr<CellsResult>> {
        options.progress = heard;
        const bool has_air = input->surface == Surface::free;
        if (has_air) options.detail = Detail::polygons;
        VORPIPE_VAR(diagram, has_air ? freeCells(session, input->sites, options)
                                     : session.cells(input->sites, options));
        options.progress = nullptr;
        return std::make_shared<CellsResult>(
            resultOf(input, std::move(options), std::move(diagram), threads));
      });
}

std::shared_ptr<CellsResult> SharedSession::cells(const std::shared_ptr<const Input>& input,
                                                  const std::string& detail, const std::string& search,
                                                  int neighbors, const py::object& progress) {
  CellsOptions options = cellsOptionsOf(*input);
  options.detail = chosen<Detail>("detail", detail);
  options.search = {chosen<Search>("search", search), neighbors};
  return find(input, std::move(options), progress);
}

std::shared_ptr<PictureResult> SharedSession::render(const std::shared_ptr<const Input>& input,
                                                     const Look& look, const py::object& progress) {
  return use<std::shared_ptr<PictureResult>>(
      progress,
      [input, &look, options = renderOptionsOf(look, *input)](
          Session& session, const Progress& heard) mutable -> Result<std::shared_ptr<PictureResult>> {
        options.progress = heard;
        VORPIPE_TRY(takeColors(look, *input, session.threads(), options));
        VORPIPE_VAR(rendering, session.render(input->sites, options));
        if (input->surface == Surface::free) {
          auto taken = takeOutAir(input->sites, options, rendering.image, session.threads());
          if (!taken) return tl::unexpected(std::move(taken.error()));
        }
        options.progress = nullptr;
        return std::make_shared<PictureResult>(
            PictureResult{input, std::move(options), std::move(rendering)});
      });
}

std::shared_ptr<CellsResult> SharedSession::shapes(const std::shared_ptr<const Input>& input,
                                                   const Look& look, const std::string& path,
                                                   const py::object& progress) {
  static_cast<void>(shapesFormatOf(path));
  CellsOptions options = cellsOptions(renderOptionsOf(look, *input));
  options.detail = Detail::polygons;
  return find(input, std::move(options), progress);
}

std::shared_ptr<RelaxResult> SharedSession::relax(const std::shared_ptr<const Input>& input,
                                                  const RelaxArguments& given, const py::object& progress) {
  return use<std::shared_ptr<RelaxResult>>(
      progress,
      [input, options = relaxOptionsOf(*input, given)](
          Session& session, const Progress& heard) mutable -> Result<std::shared_ptr<RelaxResult>> {
        const auto most = static_cast<double>(std::max<std::uint64_t>(options.iterations, 1));
        double done = 0;
        options.progress = [&](std::string_view, double) { return heard("relax", done); };
        auto relaxed = vorpipe::relax(session, input->sites, options, [&](const Relaxation& relaxation) {
          done = static_cast<double>(relaxation.trace().size() - 1) / most;
          return true;
        });
        if (!relaxed) return tl::unexpected(std::move(relaxed.error()));
        return std::make_shared<RelaxResult>(RelaxResult{input, std::move(*relaxed)});
      });
}

/// A function of Python's that the thread of a run calls. What it raised is kept for the thread that waits.
struct SharedSession::StepFunction {
  py::object function;
  std::exception_ptr raised;

  bool call(const TransportStep& step) {
    const py::gil_scoped_acquire gil;
    try {
      return !saysStop(function(step));
    } catch (...) {
      raised = std::current_exception();
      return false;
    }
  }
  static std::shared_ptr<StepFunction> of(const py::object& function) {
    if (function.is_none()) return nullptr;
    // The thread of the run may be the last that has it.
    return {new StepFunction{function, nullptr}, [](StepFunction* last) {
              const py::gil_scoped_acquire gil;
              delete last;
            }};
  }
};

std::shared_ptr<TransportResult> SharedSession::transport(const std::shared_ptr<const Input>& input,
                                                          const TransportArguments& given,
                                                          const py::object& callback,
                                                          const py::object& progress) {
  const auto told = StepFunction::of(callback);
  auto result = use<std::shared_ptr<TransportResult>>(
      progress,
      [this, input, told, options = transportOptionsOf(*input, given), given](
          Session& session, const Progress& heard) mutable -> Result<std::shared_ptr<TransportResult>> {
        double first = 0, done = 0;
        bool stopped = false;
        options.progress = [&](std::string_view, double) { return !(stopped = !heard("transport", done)); };
        if (given.normalize || given.fill) {
          auto fit = fillDomain(session, input->sites.size(), given.fill.value_or(1), options);
          if (!fit) return tl::unexpected(std::move(fit.error()));
        }
        auto found = vorpipe::transport(session, input->sites, options, [&](const TransportStep& step) {
          if (!(first > options.tolerance)) first = step.worst;
          const double part = std::log(first / step.worst) / std::log(first / options.tolerance);
          if (step.taken && part > done) done = std::min(part, 1.0);
          // Once nobody waits any more, Python may be about to end.
          if (stopped || !heard("transport", done)) return false;
          const Waiting here(this);
          return told == nullptr || told->call(step);
        });
        if (!found) return tl::unexpected(std::move(found.error()));
        return std::make_shared<TransportResult>(TransportResult{input, options.surface, std::move(*found)});
      });
  if (told != nullptr && told->raised) std::rethrow_exception(told->raised);
  return result;
}

void SharedSession::run(const py::object& progress,
                        std::function<Result<void>(Session&, const Progress&)> work) {
  use<void>(progress, std::move(work));
}

Arithmetic SharedSession::arithmetic() {
  return use<Arithmetic>(py::none(), [](Session& session, const Progress&) { return session.arithmetic(); });
}

DeviceInfo SharedSession::device() {
  return use<DeviceInfo>(
      py::none(), [](Session& session, const Progress&) -> Result<DeviceInfo> { return session.device(); });
}

std::string SharedSession::choice() {
  return use<std::string>(
      py::none(), [](Session& session, const Progress&) -> Result<std::string> { return session.choice(); });
}

void SharedSession::close() {
  if (closed_ || getpid() != process_) return;
  refuseOtherUse();
  const WithoutGil no_gil;
  const std::lock_guard lock(mutex_);
  closed_ = true;
  session_.reset();
}

CellsOptions cellsOptionsOf(const Input& input) {
  CellsOptions options{};
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.globe = input.globe;
  options.density = input.density;
  return options;
}

void defineSession(py::module_& module) {
  using Shared = std::shared_ptr<Input>;
  py::class_<SharedSession, std::shared_ptr<SharedSession>>(module, "Session", "One backend, ready to work.")
      .def(py::init([](const std::string& backend, const std::string& device, int threads, bool validation,
                       const MaskArguments& mask) {
             return std::make_shared<SharedSession>(
                 backendOptionsOf(backend, device, threads, validation, mask));
           }),
           py::arg("backend"), py::arg("device"), py::arg("threads"), py::arg("validation"), py::arg("mask"))
      .def(
          "cells",
          [](SharedSession& session, const Shared& input, const std::string& detail,
             const std::string& search, int neighbors, const py::object& progress) {
            return session.cells(input, detail, search, neighbors, progress);
          },
          py::arg("input"), py::arg("detail"), py::arg("search"), py::arg("neighbors"), py::arg("progress"))
      .def(
          "render",
          [](SharedSession& session, const Shared& input, const Look& look, const py::object& progress) {
            return session.render(input, look, progress);
          },
          py::arg("input"), py::arg("look"), py::arg("progress"))
      .def(
          "shapes",
          [](SharedSession& session, const Shared& input, const Look& look, const std::string& path,
             const py::object& progress) { return session.shapes(input, look, path, progress); },
          py::arg("input"), py::arg("look"), py::arg("path"), py::arg("progress"))
      .def(
          "relax",
          [](SharedSession& session, const Shared& input, const RelaxArguments& given,
             const py::object& progress) { return session.relax(input, given, progress); },
          py::arg("input"), py::arg("arguments"), py::arg("progress"))
      .def(
          "transport",
          [](SharedSession& session, const Shared& input, const TransportArguments& given,
             const py::object& callback,
             const py::object& progress) { return session.transport(input, given, callback, progress); },
          py::arg("input"), py::arg("arguments"), py::arg("callback"), py::arg("progress"))
      .def("arithmetic", &SharedSession::arithmetic)
      .def("device", &SharedSession::device)
      .def("choice", &SharedSession::choice)
      .def("close", &SharedSession::close)
      .def_property_readonly("closed", &SharedSession::isClosed);
}

}  // namespace vorpipe::python
