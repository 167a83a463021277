#include "io/base/system_beside.h"

#include <fmt/core.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/wkt_system.h"

namespace vorpipe {

std::string besides(const std::string& path, const std::string& extension) {
  std::filesystem::path other(path);
  if (lowerExtension(path) == ".gz") other.replace_extension();
  return other.replace_extension(extension).string();
}

Result<void> readSystemBeside(const std::string& path, CoordinateSystem& system) {
  constexpr std::size_t longest = std::size_t{1} << 20;  // bytes
  if (path == "-" || hasName(system)) return {};
  const std::string beside = besides(path, ".prj");
  std::error_code none;
  if (!std::filesystem::is_regular_file(beside, none)) return {};
  auto file = InputFile::open(beside);
  if (!file) return tl::unexpected(std::move(file.error()));
  const auto text = readText(*file, longest);
  if (!text) return tl::unexpected(text.error());
  auto read = systemOfWkt(*text);
  if (!read) return inputError(fmt::format("{}: is no coordinate system in WKT", beside));
  if (compared(*read, system) == SystemsAre::different) {
    return inputError(fmt::format("{}: says {}, and {} has {}", beside, nameOf(*read), path, nameOf(system)));
  }
  system = std::move(*read);
  return {};
}

}  // namespace vorpipe
