/// Refusal of outlines.
#pragma once

#include <string>
#include <tl/expected.hpp>

#include "base/refusal.h"
#include "vorpipe.h"

namespace vorpipe {

/// Returns an error (input) about the outline: `what` is wrong with it.
inline tl::unexpected<Error> refuseOutline(const std::string& what) {
  return tl::unexpected(refusalOf(Subject::outline, what));
}

}  // namespace vorpipe
