#include "io/domain/world_file.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/attributes/system_beside.h"
#include "io/files/error.h"
#include "io/text/line_reader.h"
#include "io/text/number.h"

namespace vorpipe {
namespace {

constexpr std::array<std::string_view, 4> world_extensions = {".pgw", ".pngw", ".tfw", ".wld"};
constexpr std::size_t world_numbers = 6;

using WorldNumbers = std::array<double, world_numbers>;

Result<WorldNumbers> numbersIn(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  LineReader lines(std::move(*file));
  WorldNumbers numbers{};
  std::size_t found = 0;
  while (true) {
    const auto line = lines.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line) break;
    const std::string_view text = trimmed(**line);
    if (text.empty()) continue;
    const auto number = parseNumber(text);
    if (!number) return lines.errorAt(1, number.error());
    if (found == world_numbers)
      return lines.errorAt(1, "a world file has 6 numbers, and this is another one");
    numbers[found++] = *number;
  }
  if (found == world_numbers) return numbers;
  return inputError(fmt::format("{}: has {} numbers; a world file has {}", path, found, world_numbers));
}

}  // namespace

Result<std::optional<Box>> boxBeside(const std::string& path, int width, int height) {
  for (const std::string_view extension : world_extensions) {
    const std::string beside = besides(path, std::string(extension));
    std::error_code none;
    if (!std::filesystem::is_regular_file(beside, none)) continue;
    const auto numbers = numbersIn(beside);
    if (!numbers) return tl::unexpected(numbers.error());
    const auto [across, turn_y, turn_x, down, x, y] = *numbers;
    if (turn_x != 0 || turn_y != 0) return inputError(fmt::format("{}: turns the pixels", beside));
    if (!(across > 0) || !(down < 0)) {
      return inputError(
          fmt::format("{}: pixels are {} wide and {} high; more than 0 and less than 0 are "
                      "needed, since rows count from the top",
                      beside, across, down));
    }
    const double west = x - across / 2, north = y - down / 2;
    return Box{west, north + height * down, west + width * across, north};
  }
  return std::nullopt;
}

}  // namespace vorpipe
