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
