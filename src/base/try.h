/// Error propagation.
#pragma once

#include <utility>

#include "vorpipe.h"

/// Returns from the enclosing function with the error of a result, if it is one.
#define VORPIPE_TRY(...)                                \
  if (auto tried = (__VA_ARGS__); !tried.has_value()) { \
    return tl::unexpected(std::move(tried).error());    \
  }                                                     \
  static_assert(true)

#define VORPIPE_JOIN_NOW(a, b) a##b
#define VORPIPE_JOIN(a, b) VORPIPE_JOIN_NOW(a, b)

/// Names the value of a result, as a constant or a variable of the enclosing block; or returns with the
/// error. `VORPIPE_LET(input, read(path));` stands for `const auto input = read(path)`, with the error
/// handled.
#define VORPIPE_LET(name, ...) VORPIPE_NAMED(const auto, name, (__VA_ARGS__))
#define VORPIPE_VAR(name, ...) VORPIPE_NAMED(auto, name, (__VA_ARGS__))
#define VORPIPE_NAMED(type, name, result)                              \
  type VORPIPE_JOIN(result_at_, __LINE__) = result;                    \
  if (!VORPIPE_JOIN(result_at_, __LINE__)) {                           \
    return tl::unexpected(VORPIPE_JOIN(result_at_, __LINE__).error()); \
  }                                                                    \
  auto& name = *VORPIPE_JOIN(result_at_, __LINE__)
