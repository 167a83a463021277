#include "session.h"

#include <pybind11/stl.h>

#include <chrono>
#include <utility>

#include "choices.h"
#include "errors.h"
#include "session_options.h"

namespace vorpipe::python {
namespace {

[[noreturn]] void raiseDevice(const char* message) { raise({ErrorCode::device, message}); }

}  // namespace

SharedSession::SharedSession(const BackendOptions& options) {
  auto opened = [&] {
    const py::gil_scoped_release no_gil;
    return Session::open(options);
  }();
  session_ = std::make_unique<Session>(valueOf(std::move(opened)));
}

SharedSession::~SharedSession() {
  // Threads and devices stayed with the process that opened them: nothing of them can be ended here.
  if (getpid() != process_) {
    static_cast<void>(session_.release());
    return;
  }
  const py::gil_scoped_release no_gil;
  session_.reset();
}

void SharedSession::lock() {
  if (getpid() != process_) {
    raiseDevice("the session belongs to the process that opened it: open another one in this process");
  }
  if (user_ == std::this_thread::get_id()) {
    raiseDevice("the session is busy with the run whose progress function this is");
  }
  constexpr auto pause = std::chrono::milliseconds(50);
  const auto locked = [&] {
    const py::gil_scoped_release no_gil;
    return mutex_.try_lock_for(pause);
  };
  while (!locked()) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

template <class Work>
auto SharedSession::use(Work work) -> decltype(work(std::declval<Session&>())) {
  lock();
  const std::unique_lock lock(mutex_, std::adopt_lock);
  if (!session_) raiseDevice("the session is closed");
  const py::gil_scoped_release no_gil;
  user_ = std::this_thread::get_id();
  auto result = work(*session_);
  user_ = std::thread::id();
  return result;
}

std::shared_ptr<CellsResult> SharedSession::cells(const std::shared_ptr<const Input>& input,
                                                  const std::string& detail, const std::string& search,
                                                  int neighbors, py::object progress) {
  CellsOptions options = cellsOptionsOf(*input);
  options.detail = chosen("detail", detail_choices, detail);
  options.search = {chosen("search", search_choices, search), neighbors};
  HeardProgress heard(std::move(progress));
  options.progress = heard.callback();
  auto diagram = use([&](Session& session) { return session.cells(input->sites, options); });
  heard.rethrow();
  options.progress = nullptr;
  return std::make_shared<CellsResult>(CellsResult{input, std::move(options), valueOf(std::move(diagram))});
}

std::shared_ptr<PictureResult> SharedSession::render(const std::shared_ptr<const Input>& input,
                                                     RenderOptions options, py::object progress) {
  HeardProgress heard(std::move(progress));
  options.progress = heard.callback();
  auto rendering = use([&](Session& session) { return session.render(input->sites, options); });
  heard.rethrow();
  options.progress = nullptr;
  return std::make_shared<PictureResult>(
      PictureResult{input, std::move(options), valueOf(std::move(rendering))});
}

Arithmetic SharedSession::arithmetic() {
  return valueOf(use([](Session& session) { return session.arithmetic(); }));
}

DeviceInfo SharedSession::device() {
  return use([](Session& session) { return session.device(); });
}

std::string SharedSession::choice() {
  return use([](Session& session) { return session.choice(); });
}

void SharedSession::close() {
  if (closed_ || getpid() != process_) return;
  lock();
  const std::unique_lock lock(mutex_, std::adopt_lock);
  const py::gil_scoped_release no_gil;
  closed_ = true;
  session_.reset();
}

CellsOptions cellsOptionsOf(const Input& input) {
  CellsOptions options{};
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
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
             const std::string& search, int neighbors, py::object progress) {
            return session.cells(input, detail, search, neighbors, std::move(progress));
          },
          py::arg("input"), py::arg("detail"), py::arg("search"), py::arg("neighbors"), py::arg("progress"))
      .def(
          "render",
          [](SharedSession& session, const Shared& input, const std::optional<std::pair<int, int>>& size,
             const std::string& color, const std::string& colormap, bool edges, bool show_sites,
             const std::string& search, int neighbors, py::object progress) {
            const PictureSize wanted =
                size ? PictureSize{size->first, size->second} : defaultSize(input->domain);
            RenderOptions options{};
            options.domain = input->domain;
            options.outline = input->outline;
            options.periodic = input->periodic;
            options.width = wanted.width;
            options.height = wanted.height;
            options.color = chosen("color", color_choices, color);
            options.colormap = colormap;
            options.edges = edges;
            options.show_sites = show_sites;
            options.search = {chosen("search", search_choices, search), neighbors};
            return session.render(input, std::move(options), std::move(progress));
          },
          py::arg("input"), py::arg("size"), py::arg("color"), py::arg("colormap"), py::arg("edges"),
          py::arg("show_sites"), py::arg("search"), py::arg("neighbors"), py::arg("progress"))
      .def("arithmetic", &SharedSession::arithmetic)
      .def("device", &SharedSession::device)
      .def("choice", &SharedSession::choice)
      .def("close", &SharedSession::close)
      .def_property_readonly("closed", &SharedSession::isClosed);
}

}  // namespace vorpipe::python
