/// The path of standard output, which `-` stands for.
#pragma once

#include <string_view>

namespace vorpipe::cli {

inline constexpr std::string_view standard_output = "/dev/stdout";

}  // namespace vorpipe::cli
