/// Shortens descriptions.
#pragma once

#include <string>

namespace vorpipe::cli {

/// Returns the start of a description: up to its first `:`, `;`, `[` or the end of its first sentence.
std::string briefly(const std::string& description);

}  // namespace vorpipe::cli
