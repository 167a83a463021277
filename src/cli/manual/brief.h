/// A description in few words.
#pragma once

#include <string>

namespace vorpipe::cli {

/// How a description begins: up to its first `:`, `;`, `[` or the end of its first sentence.
std::string briefly(const std::string& description);

}  // namespace vorpipe::cli
