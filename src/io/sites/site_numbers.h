/// Reads a number for each site from a separate file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Meaning of a file's numbers.
struct NumbersKind {
  std::string_view one, many;  ///< "weight", "weights", for messages
  /// Whether the first line of a text is a header that names the numbers, not a number.
  std::function<bool(std::string_view line)> header;
  /// Converts a finite number to its value. The error states what is wrong with it; `text` is the number as
  /// written.
  std::function<tl::expected<double, std::string>(double number, std::string_view text)> value;
};

/// Reads one finite number for each of `count` sites, in their order: from .txt or .csv, a number to a line,
/// where # begins a comment; or from .npy, numbers that areNumbers() takes, of shape (N,) or (N, 1). Errors:
/// a path or data that is wrong, or not as many numbers as sites, with file, line and column (input); reading
/// failed or memory ran out (device).
Result<std::vector<double>> readSiteNumbers(const std::string& path, std::uint64_t count,
                                            const NumbersKind& kind);

}  // namespace vorpipe
