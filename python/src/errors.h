/// The library's errors as exceptions of Python, which vorpipe/_errors.py defines.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "vorpipe.h"

namespace vorpipe::python {

/// Throws what Python sees as vorpipe.InputError, DeviceError or Cancelled, with code and subject. The
/// message begins with the argument that the error is about. The GIL is held.
[[noreturn]] void raise(Error error);

/// Throws an InputError about an argument: "argument: message".
[[noreturn]] void raiseInput(std::string_view argument, const std::string& message);

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
