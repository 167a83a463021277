#include "errors.h"

#include <fmt/core.h>
#include <pybind11/pybind11.h>

#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "base/option_rows.h"

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
      return "domain";
    case Subject::period:
      return "periodic";
    case Subject::density:
      return "density";
    case Subject::search:
      return "search";
    case Subject::masses:
      return "masses";
  }
  return {};
}

/// The argument whose name a message begins with, in the library's words; empty where it begins with none.
/// The message gets the argument's name instead.
std::string_view takeArgument(std::string& message) {
  std::vector<std::string_view> arguments{"color_scale", "color_range", "color",  "legend",  "domain",
                                          "outline",     "margin",      "repair", "project", "periodic"};
  forEachRow(picture_rows, [&](const auto& row) { arguments.emplace_back(row.name); });
  for (const std::string_view argument : arguments) {
    const std::string words = nameWith(' ', std::string(argument));
    if (!message.starts_with(words) || message.size() == words.size()) continue;
    const std::string_view rest = std::string_view(message).substr(words.size());
    const std::size_t separator = rest.starts_with(": ") ? 2 : rest.starts_with(' ') ? 1 : 0;
    if (separator == 0) continue;
    message = fmt::format("{}: {}", argument, rest.substr(separator));
    return argument;
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

void setError(Kind kind, const std::string& message, std::string_view argument) {
  const py::object exception = py::module_::import("vorpipe._errors").attr(kind.exception);
  const py::object subject = argument.empty() ? py::object(py::none()) : py::cast(argument);
  const py::object error = exception(textOf(message), kind.code, subject);
  PyErr_SetObject(exception.ptr(), error.ptr());
}

[[noreturn]] void throwAs(Kind kind, const std::string& message, std::string_view argument) {
  setError(kind, message, argument);
  throw py::error_already_set();
}

}  // namespace

py::str textOf(std::string_view text) {
  PyObject* const made =
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace");
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

py::list textsOf(const std::vector<std::string>& texts) {
  py::list made;
  for (const std::string& text : texts) made.append(textOf(text));
  return made;
}

void raise(Error error) {
  if (const std::string_view named = takeArgument(error.message); !named.empty()) {
    throwAs(kindOf(error.code), error.message, named);
  }
  const std::string_view argument = argumentOf(error.subject);
  if (!argument.empty()) {
    // The argument stands for the subject's name.
    const std::string name = fmt::format("{}: ", nameOf(error.subject));
    if (error.message.starts_with(name)) error.message.erase(0, name.size());
    error.message.insert(0, fmt::format("{}: ", argument));
  }
  throwAs(kindOf(error.code), error.message, argument);
}

void raise(const std::exception_ptr& refused) {
  try {
    std::rethrow_exception(refused);
  } catch (const std::bad_alloc&) {
    throw;  // which registerErrors() has seen to
  } catch (const std::exception& error) {
    raise({ErrorCode::device, error.what()});
  }
}

void raiseInput(std::string_view argument, const std::string& message) {
  throwAs(kindOf(ErrorCode::input), fmt::format("{}: {}", argument, message), argument);
}

void registerErrors() {
  py::register_local_exception_translator([](std::exception_ptr raised) {
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const std::bad_alloc&) {
      try {
        setError(kindOf(ErrorCode::device), "there is not enough memory for this", {});
      } catch (py::error_already_set& error) {
        error.restore();
      }
    }
  });
}

}  // namespace vorpipe::python
