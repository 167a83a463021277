#include "io/base/npy_array.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cstddef>

namespace vorpipe {

std::string npyHeader(std::string_view type, std::span<const std::uint64_t> shape) {
  constexpr std::size_t preamble_size = 10, alignment = 64;
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                                 fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  while ((preamble_size + text.size() + 1) % alignment != 0) {
    text += ' ';
  }
  text += '\n';
  std::string header("\x93NUMPY");
  header += {'\x01', '\x00', static_cast<char>(text.size() & 0xFF), static_cast<char>(text.size() >> 8)};
  return header + text;
}

}  // namespace vorpipe
