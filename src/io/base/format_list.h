/// Lists of output formats, one per file extension.
#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/error.h"
#include "io/base/extension.h"
#include "vorpipe.h"

namespace vorpipe {

/// Returns the extension of each of `formats`, in their order.
template <class Format>
std::vector<std::string_view> extensionsOf(std::span<const Format* const> formats) {
  std::vector<std::string_view> extensions;
  for (const Format* format : formats) extensions.push_back(format->extension);
  return extensions;
}

/// Returns the format that the path's extension names; never null. Error (input): it names none; `what` is
/// what the formats are for.
template <class Format>
Result<const Format*> formatFor(const std::string& path, std::string_view what,
                                std::span<const Format* const> formats) {
  const std::string extension = lowerExtension(path);
  const auto found =
      std::ranges::find_if(formats, [&](const Format* format) { return format->extension == extension; });
  if (found != formats.end()) return *found;
  return inputError(fmt::format("{}: unknown kind of file for {}; known are {}", path, what,
                                fmt::join(extensionsOf(formats), ", ")));
}

}  // namespace vorpipe
