#include "io/files/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace vorpipe {
namespace {

/// Whether the system has no room for a file that may be as it should.
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

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result;
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  if (text.size() > longest) result += "...";
  return result;
}

std::string quoted(std::string_view text) { return fmt::format("\"{}\"", printable(text)); }

}  // namespace vorpipe
