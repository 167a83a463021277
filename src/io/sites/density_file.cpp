#include "io/sites/density_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/memory_room.h"
#include "io/base/npy_elements.h"
#include "io/base/npy_header.h"
#include "io/pictures/png_file.h"
#include "io/sites/place_beside.h"

namespace vorpipe {
namespace {

template <class Number>
Result<Density> readElements(InputFile& file, const NpyHeader& header) {
  const std::uint64_t rows = header.shape[0], columns = header.shape[1];
  VORPIPE_TRY(checkRoom(file.name(), "pixels", rows * columns * sizeof(double)));
  Density density{static_cast<int>(columns), static_cast<int>(rows), {}};
  density.values.resize(rows * columns);
  const auto read = eachPixel<Number>(
      file, header, [&](std::uint64_t row, std::uint64_t column, Number element) -> Result<void> {
        const auto value = static_cast<double>(element);
        if (!std::isfinite(value) || value < 0) {
          return inputError(fmt::format("{}: element [{}, {}] (counted from 0) is {}; a density is 0 or more",
                                        file.name(), row, column, value));
        }
        density.values[row * columns + column] = value;
        return {};
      });
  if (!read) {
    return tl::unexpected(read.error());
  }
  return density;
}

Result<Density> readNpy(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) {
    return tl::unexpected(file.error());
  }
  const auto header = readNpyHeader(*file);
  if (!header) {
    return tl::unexpected(header.error());
  }
  const auto& shape = header->shape;
  if (areNumbers(*header) && shape.size() == 2 && std::min(shape[0], shape[1]) >= 1 &&
      std::max(shape[0], shape[1]) <= max_extent) {
    return withType(*header, [&]<class Number>(Number) { return readElements<Number>(*file, *header); });
  }
  return inputError(fmt::format(
      "{}: holds {}; numbers (H, W), float32, float64 or whole ones, with 1 to {} rows and columns are "
      "needed",
      path, header->description, max_extent));
}

}  // namespace

Result<DensityFile> readDensity(const std::string& path, const std::optional<Box>& box) {
  const std::string extension = lowerExtension(path);
  try {
    if (extension != ".png" && extension != ".npy") {
      const bool tiff = extension == ".tif" || extension == ".tiff";
      return inputError(fmt::format("{}: unknown kind of file; known are .png and .npy{}", path,
                                    tiff ? ", which keep their place by a world file, as `gdal_translate -of "
                                           "PNG -co WORLDFILE=YES` writes it"
                                         : ""));
    }
    auto density = extension == ".png" ? readPngDarkness(path) : readNpy(path);
    if (!density) return tl::unexpected(std::move(density.error()));
    DensityFile read{std::move(*density)};
    read.density.box = box;
    if (box) return read;
    auto place = placeBeside(path, read.density.width, read.density.height);
    if (!place) return tl::unexpected(std::move(place.error()));
    read.density.box = place->box;
    read.system = std::move(place->system);
    return read;
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its pixels");
  }
}

}  // namespace vorpipe
