#include "io/sites/density_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/coordinate_system.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/line_reader.h"
#include "io/base/npy_array.h"
#include "io/base/number.h"
#include "io/pictures/jpeg_file.h"
#include "io/pictures/png_file.h"

namespace vorpipe {
namespace {

constexpr std::array<std::string_view, 6> world_extensions = {".pgw",  ".pngw", ".jgw",
                                                              ".jpgw", ".tfw",  ".wld"};
constexpr std::size_t number_count = 6;

/// A GeoTransform of GDAL: x of the left side, width of a pixel, a turn, y of the upper side, a turn, height.
using SixNumbers = std::array<double, number_count>;

bool isFile(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

/// Sets the box of the pixels.
Result<void> setBox(const SixNumbers& transform, const std::string& name, Density& density) {
  const auto [west, across, turn_x, north, turn_y, down] = transform;
  if (turn_x != 0 || turn_y != 0) return inputError(fmt::format("{}: turns the pixels", name));
  if (!(across > 0) || !(down < 0)) {
    return inputError(
        fmt::format("{}: pixels are {} wide and {} high; more than 0 and less than 0 are "
                    "needed, since rows count from the top",
                    name, across, down));
  }
  density.box = Box{west, north + density.height * down, west + density.width * across, north};
  return {};
}

Result<SixNumbers> numbersIn(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  LineReader lines(std::move(file));
  SixNumbers numbers{};
  std::size_t found = 0;
  while (true) {
    VORPIPE_LET(line, lines.next());
    if (!line) break;
    const std::string_view text = trimmed(*line);
    if (text.empty()) continue;
    const auto number = parseNumber(text);
    if (!number) return lines.errorAt(1, number.error());
    if (found == number_count) return lines.errorAt(1, "a world file has 6 numbers, and this is another one");
    numbers[found++] = *number;
  }
  if (found == number_count) return numbers;
  return inputError(fmt::format("{}: has {} numbers; a world file has {}", path, found, number_count));
}

/// Returns the content of the first element of this name, which holds only text; none if there is none.
std::optional<std::string_view> textIn(std::string_view xml, std::string_view name) {
  const std::string begin = fmt::format("<{}", name), end = fmt::format("</{}>", name);
  for (std::size_t at = xml.find(begin); at != std::string_view::npos; at = xml.find(begin, at + 1)) {
    std::string_view rest = xml.substr(at + begin.size());
    // Another name may begin the same way.
    if (rest.empty() || std::string_view(" \t\r\n>").find(rest.front()) == std::string_view::npos) continue;
    rest = rest.substr(std::min(rest.find('>'), rest.size() - 1) + 1);
    return rest.substr(0, rest.find(end));
  }
  return std::nullopt;
}

/// Replaces XML's escapes by their characters.
std::string plainOf(std::string_view xml) {
  constexpr std::array<std::pair<std::string_view, char>, 5> marks = {
      {{"&quot;", '"'}, {"&apos;", '\''}, {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}}};
  std::string text;
  while (!xml.empty()) {
    const auto* const mark =
        std::ranges::find_if(marks, [&](const auto& each) { return xml.starts_with(each.first); });
    text += mark == marks.end() ? xml.front() : mark->second;
    xml.remove_prefix(mark == marks.end() ? 1 : mark->first.size());
  }
  return text;
}

Result<SixNumbers> transformIn(std::string_view text, const std::string& name) {
  SixNumbers numbers{};
  for (double& number : numbers) {
    const std::size_t comma = std::min(text.find(','), text.size());
    // GDAL puts blanks and line ends around them.
    std::string_view part = text.substr(0, comma);
    part = part.substr(std::min(part.find_first_not_of(" \t\r\n"), part.size()));
    part = part.substr(0, part.find_last_not_of(" \t\r\n") + 1);
    const auto read = parseNumber(part);
    if (!read) return inputError(fmt::format("{}: its GeoTransform: {}", name, read.error()));
    number = *read;
    text = text.substr(std::min(comma + 1, text.size()));
  }
  return numbers;
}

/// Takes the box from GDAL's file, if nothing else gave it, and the system.
Result<void> takeAux(const std::string& path, DensityFile& read) {
  constexpr std::size_t longest = std::size_t{1} << 24;  // bytes: it has histograms and tables as well
  const std::string name = path + ".aux.xml";
  if (!isFile(name)) return {};
  VORPIPE_VAR(file, InputFile::open(name));
  VORPIPE_LET(xml, readText(file, longest));
  if (const auto transform = textIn(xml, "GeoTransform"); transform && !read.density.box) {
    VORPIPE_TRY(transformIn(*transform, name).and_then([&](const SixNumbers& numbers) {
      return setBox(numbers, name, read.density);
    }));
  }
  const auto srs = textIn(xml, "SRS");
  if (!srs || !read.density.box) return {};
  auto system = systemNamed(plainOf(*srs));
  if (!system) return inputError(fmt::format("{}: its SRS: {}", name, system.error()));
  read.system = std::move(*system);
  return {};
}

template <class Number>
Result<Density> readPixels(InputFile& file, const NpyHeader& header) {
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
  if (!read) return tl::unexpected(read.error());
  return density;
}

Result<Density> readArrayDensity(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  VORPIPE_LET(header, readNpyHeader(file));
  const auto& shape = header.shape;
  if (areNumbers(header) && shape.size() == 2 && std::min(shape[0], shape[1]) >= 1 &&
      std::max(shape[0], shape[1]) <= max_extent) {
    return withType(header, [&]<class Number>(Number) { return readPixels<Number>(file, header); });
  }
  return inputError(fmt::format(
      "{}: holds {}; numbers (H, W), float32, float64 or whole ones, with 1 to {} rows and columns are "
      "needed",
      path, header.description, max_extent));
}

/// Reads the darkness of a photograph as that of a PNG.
Result<Density> readDarkness(const std::string& path) {
  VORPIPE_LET(image, readJpeg(path));
  VORPIPE_TRY(checkRoom(path, "pixels", image.rgba.size() * sizeof(double)));
  return darknessOf(image);
}

}  // namespace

// The six numbers of a world file: the first and the fourth are the size of a pixel, the fourth less than 0,
// the last two the center of the upper left one. The system is from GDAL's file or a .prj beside it.
Result<void> findPlace(const std::string& path, DensityFile& read) {
  for (const std::string_view extension : world_extensions) {
    const std::string beside = besides(path, std::string(extension));
    if (read.density.box || !isFile(beside)) continue;
    VORPIPE_TRY(numbersIn(beside).and_then([&](const SixNumbers& numbers) {
      const auto [across, turn_y, turn_x, down, x, y] = numbers;
      return setBox({x - across / 2, across, turn_x, y - down / 2, turn_y, down}, beside, read.density);
    }));
  }
  VORPIPE_TRY(takeAux(path, read));
  return read.density.box ? readSystemBeside(path, read.system) : Result<void>();
}

Result<DensityFile> readDensity(const std::string& path, const std::optional<Box>& box) {
  const std::string extension = lowerExtension(path);
  try {
    const bool jpeg = extension == ".jpg" || extension == ".jpeg";
    if (extension != ".png" && extension != ".npy" && !jpeg) {
      const bool tiff = extension == ".tif" || extension == ".tiff";
      return inputError(fmt::format("{}: unknown kind of file; known are .png, .jpg and .npy{}", path,
                                    tiff ? ", which keep their place by a world file, as `gdal_translate -of "
                                           "PNG -co WORLDFILE=YES` writes it"
                                         : ""));
    }
    VORPIPE_VAR(density, jpeg                  ? readDarkness(path)
                         : extension == ".png" ? readPngDarkness(path)
                                               : readArrayDensity(path));
    DensityFile read{std::move(density)};
    read.density.box = box;
    if (box) return read;
    VORPIPE_TRY(findPlace(path, read));
    return read;
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its pixels");
  }
}

}  // namespace vorpipe
