#include "view/test_screen.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace vorpipe::view::test {
namespace {

// Numbers of the file's head, as XWDFile.h has them: 32 bits each, the highest byte first.
enum Field : std::size_t {
  header_size = 0,
  pixmap_width = 4,
  pixmap_height = 5,
  byte_order = 7,
  bits_per_pixel = 11,
  bytes_per_line = 12,
  colors = 19
};
constexpr std::size_t color_bytes = 12;

std::uint32_t field(const std::string& file, Field which) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(file.at(4 * which + i));
  return value;
}

}  // namespace

Image screenPart(int width, int height) {
  const char* const path = std::getenv("VORPIPE_TEST_SCREEN");
  if (path == nullptr) return {};
  std::ifstream stream(path, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (file.size() < 100 || field(file, byte_order) != 0 || field(file, bits_per_pixel) != 32) return {};
  if (static_cast<std::uint32_t>(width) > field(file, pixmap_width) ||
      static_cast<std::uint32_t>(height) > field(file, pixmap_height)) {
    return {};
  }
  const std::size_t first = field(file, header_size) + color_bytes * field(file, colors);
  Image part;
  part.width = width;
  part.height = height;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const std::size_t at = first + static_cast<std::size_t>(row) * field(file, bytes_per_line) +
                             4 * static_cast<std::size_t>(column);
      const auto byte = [&](std::size_t i) {
        return std::uint32_t{static_cast<unsigned char>(file.at(at + i))};
      };
      // Blue is the lowest byte there.
      part.rgba.push_back(byte(2) | byte(1) << 8 | byte(0) << 16 | 0xFF000000U);
    }
  }
  return part;
}

}  // namespace vorpipe::view::test
