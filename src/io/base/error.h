/// Errors of the io functions: one line that begins with the file.
#pragma once

#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

/// The data or a path is wrong (exit code 2).
tl::unexpected<Error> inputError(std::string message);

/// Reading or writing failed, or memory ran out (exit code 3).
tl::unexpected<Error> deviceError(std::string message);

/// "FILE: what: REASON", where REASON is the system's text for the errno `code`. A device error, whatever
/// `kind` is, if the system has no room: a full disk, too many open files.
tl::unexpected<Error> systemError(ErrorCode kind, std::string_view file, std::string_view what, int code);

}  // namespace vorpipe
