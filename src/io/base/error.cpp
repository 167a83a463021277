#include "io/base/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace vorpipe {
namespace {

/// Whether the system lacks room for a file that may itself be valid.
bool isWantOfRoom(int code) {
  constexpr std::array codes{ENOSPC, EDQUOT, EMFILE, ENFILE, ENOMEM, EIO};
  return std::ranges::find(codes, code) != codes.end();
}

}  // namespace

tl::unexpected<Error> inputError(std::string message) {
  return tl::unexpected(Error{ErrorCode::input, std::move(message)});
}

tl::unexpected<Error> deviceError(std::string message) {
  return tl::unexpected(Error{ErrorCode::device, std::move(message)});
}

tl::unexpected<Error> systemError(ErrorCode kind, std::string_view file, std::string_view what, int code) {
  if (isWantOfRoom(code)) kind = ErrorCode::device;
  return tl::unexpected(
      Error{kind, fmt::format("{}: {}: {}", file, what, std::generic_category().message(code))});
}

}  // namespace vorpipe
