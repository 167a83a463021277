#include "errors.h"

#include <fmt/core.h>
#include <pybind11/pybind11.h>

namespace vorpipe::python {
namespace {

namespace py = pybind11;

/// The argument that gives a run this part of its input; empty for none.
std::string_view argumentOf(Subject subject) {
  switch (subject) {
    case Subject::none:
      break;
    case Subject::sites:
      return "points";
    case Subject::weights:
      return "weights";
    case Subject::domain:
      return "domain";
    case Subject::outline:
      return "outline";
    case Subject::period:
      return "periodic";
    case Subject::density:
      return "density";
    case Subject::search:
      return "search";
  }
  return {};
}

struct Kind {
  const char *exception, *code;
};

Kind kindOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::input:
      return {"InputError", "input"};
    case ErrorCode::device:
      break;
    case ErrorCode::cancelled:
      return {"Cancelled", "cancelled"};
  }
  return {"DeviceError", "device"};
}

[[noreturn]] void raise(Kind kind, const std::string& message, std::string_view argument) {
  const py::object exception = py::module_::import("vorpipe._errors").attr(kind.exception);
  const py::object subject = argument.empty() ? py::object(py::none()) : py::cast(argument);
  const py::object error = exception(message, kind.code, subject);
  PyErr_SetObject(exception.ptr(), error.ptr());
  throw py::error_already_set();
}

}  // namespace

void raise(Error error) {
  const std::string_view argument = argumentOf(error.subject);
  if (!argument.empty()) {
    // The argument stands for the subject's name.
    const std::string name = fmt::format("{}: ", nameOf(error.subject));
    if (error.message.starts_with(name)) error.message.erase(0, name.size());
    error.message.insert(0, fmt::format("{}: ", argument));
  }
  raise(kindOf(error.code), error.message, argument);
}

void raiseInput(std::string_view argument, const std::string& message) {
  raise(kindOf(ErrorCode::input), fmt::format("{}: {}", argument, message), argument);
}

}  // namespace vorpipe::python
