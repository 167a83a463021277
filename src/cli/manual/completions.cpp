#include "cli/manual/completions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorpipe::cli {

std::string spaced(const std::vector<std::string>& words) { return fmt::to_string(fmt::join(words, " ")); }

}  // namespace vorpipe::cli
