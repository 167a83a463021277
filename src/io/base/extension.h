/// Kinds of files by extension.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Returns the extension of `path` in lower case, with its dot; empty if there is none.
std::string lowerExtension(const std::string& path);

/// Returns the extension that identifies an input's format: as lowerExtension, except .csv for x.csv.gz.
std::string inputExtension(const std::string& path);

/// Returns the path with another extension, which begins with a dot; of x.csv.gz, both extensions are
/// replaced.
std::string besides(const std::string& path, const std::string& extension);

/// Returns the extension of each of `formats`, in their order.
template <class Format>
std::vector<std::string_view> extensionsOf(std::span<const Format* const> formats) {
  std::vector<std::string_view> extensions;
  for (const Format* format : formats) extensions.push_back(format->extension);
  return extensions;
}

/// The error (input) about a file for `what` whose extension is none of those known.
tl::unexpected<Error> unknownExtension(const std::string& path, std::string_view what,
                                       const std::vector<std::string_view>& known);

/// Returns the format that the path's extension names; never null. Error (input): it names none; `what` is
/// what the formats are for.
template <class Format>
Result<const Format*> formatFor(const std::string& path, std::string_view what,
                                std::span<const Format* const> formats) {
  const auto found = std::ranges::find(formats, lowerExtension(path), &Format::extension);
  if (found != formats.end()) return *found;
  return unknownExtension(path, what, extensionsOf(formats));
}

}  // namespace vorpipe
