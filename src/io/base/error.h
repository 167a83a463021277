/// How functions of io report what went wrong: one line, the file first.
#pragma once

#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

/// The data or a path is wrong (exit code 2).
tl::unexpected<Error> inputError(std::string message);

/// Reading or writing failed, or memory ran out (exit code 3).
tl::unexpected<Error> deviceError(std::string message);

/// "FILE: what: REASON", REASON being the system's word for the errno `code`. Of the device, whatever the
/// kind, where the system has no room: a full disk, too many open files.
tl::unexpected<Error> systemError(ErrorCode kind, std::string_view file, std::string_view what, int code);

}  // namespace vorpipe
