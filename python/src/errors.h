/// The library's errors as exceptions of Python, which vorpipe/_errors.py defines.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::python {

/// As Python has it. A name of a file need not be UTF-8: bytes that are not become \xNN, which can be
/// printed.
pybind11::str textOf(std::string_view text);
pybind11::list textsOf(const std::vector<std::string>& texts);

/// Throws what Python sees as vorpipe.InputError, DeviceError or Cancelled, with code and subject. The
/// message begins with the argument that the error is about. The GIL is held.
[[noreturn]] void raise(Error error);

/// Throws what the system refused a run, threads or memory, as a DeviceError.
[[noreturn]] void raise(const std::exception_ptr& refused);

/// Throws an InputError about an argument: "argument: message".
[[noreturn]] void raiseInput(std::string_view argument, const std::string& message);

/// Memory that is refused is a DeviceError wherever it is.
void registerErrors();

/// The value, or the exception. The GIL is held.
template <class T>
T valueOf(Result<T> result) {
  if (!result) raise(std::move(result.error()));
  return std::move(*result);
}
inline void valueOf(Result<void> result) {
  if (!result) raise(std::move(result.error()));
}

}  // namespace vorpipe::python
