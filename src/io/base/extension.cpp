#include "io/base/extension.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "io/base/error.h"
#include "io/base/number.h"

namespace vorpipe {

std::string lowerExtension(const std::string& path) {
  return lowerCase(std::filesystem::path(path).extension().string());
}

std::string inputExtension(const std::string& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".gz" ? lowerExtension(std::filesystem::path(path).stem().string()) : extension;
}

std::string besides(const std::string& path, const std::string& extension) {
  std::filesystem::path other(path);
  if (lowerExtension(path) == ".gz") other.replace_extension();
  return other.replace_extension(extension).string();
}

tl::unexpected<Error> unknownExtension(const std::string& path, std::string_view what,
                                       const std::vector<std::string_view>& known) {
  return inputError(
      fmt::format("{}: unknown kind of file for {}; known are {}", path, what, fmt::join(known, ", ")));
}

}  // namespace vorpipe
