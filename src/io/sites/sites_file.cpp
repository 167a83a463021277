#include "io/sites/sites_file.h"

#include <new>
#include <utility>

#include "io/files/error.h"
#include "io/files/extension.h"
#include "io/files/input_file.h"
#include "io/sites/sites_reader.h"

namespace vorpipe {
namespace {

Result<Sites> readByExtension(const std::string& path, InputFile file) {
  const std::string extension = path == "-" ? ".csv" : lowerExtension(path);
  if (extension == ".csv") {
    return readCsvSites(std::move(file));
  }
  if (extension == ".xyz" || extension == ".txt") {
    return readTextSites(std::move(file));
  }
  if (extension == ".npy") {
    return readNpySites(std::move(file));
  }
  return inputError(path + ": unknown kind of file; known are .csv, .xyz, .txt and .npy");
}

}  // namespace

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
