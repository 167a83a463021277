/// How functions report errors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace vorpipe {

/// The project's version, as `vorpipe --version` prints it.
std::string_view version();

enum class ErrorCode : std::uint8_t {
  input,      ///< the options or the data are wrong (exit code 2)
  device,     ///< no such backend or device here, or it failed (exit code 3)
  cancelled,  ///< the caller's Progress asked to stop
};

/// The part of the input that an error concerns.
enum class Subject : std::uint8_t { none, sites, weights, domain, outline, period, density, search, masses };

/// Its name, as the prefix of messages that do not name it otherwise: "outline", as in "outline: it crosses
/// itself".
std::string_view nameOf(Subject subject);

/// What went wrong outside the program: one line that names the thing, the place and what to do.
struct Error {
  ErrorCode code;
  std::string message;
  bool out_of_memory{};  ///< device error: smaller parts may fit into its memory
  Subject subject{};     ///< input error: its subject
};

template <class T>
using Result = tl::expected<T, Error>;

}  // namespace vorpipe
