#include "io/sites/sites_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "io/files/error.h"
#include "io/files/extension.h"
#include "io/files/input_file.h"
#include "io/sites/sites_reader.h"

namespace vorpipe {
namespace {

struct Kind {
  std::string_view extension;
  Result<Sites> (*read)(InputFile file);
};

constexpr std::array<Kind, 4> kinds = {
    {{".csv", readCsvSites}, {".xyz", readTextSites}, {".txt", readTextSites}, {".npy", readNpySites}}};

Result<Sites> readByExtension(const std::string& path, InputFile file) {
  const std::string extension = path == "-" ? ".csv" : lowerExtension(path);
  const auto* const kind = std::ranges::find(kinds, extension, &Kind::extension);
  if (kind != kinds.end()) return kind->read(std::move(file));
  return inputError(
      fmt::format("{}: unknown kind of file; known are {}", path, fmt::join(sitesExtensions(), ", ")));
}

}  // namespace

std::vector<std::string_view> sitesExtensions() {
  std::vector<std::string_view> extensions;
  for (const Kind& kind : kinds) extensions.push_back(kind.extension);
  return extensions;
}

Result<Sites> readSites(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) {
    return tl::unexpected(file.error());
  }
  const std::string name = file->name();
  try {
    auto sites = readByExtension(path, std::move(*file));
    if (sites && sites->size() == 0) {
      return inputError(name + ": holds no sites");
    }
    return sites;
  } catch (const std::bad_alloc&) {
    return deviceError(name + ": there is not enough memory for its sites");
  }
}

}  // namespace vorpipe
