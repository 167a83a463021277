/// The header of NumPy's .npy files, versions 1 to 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/input_file.h"

namespace vorpipe {

/// First bytes of a .npy file.
inline constexpr std::string_view npy_magic = "\x93NUMPY";

struct NpyHeader {
  char kind = 0;         ///< f: floating point, i: signed, u: unsigned, b: boolean, U: text
  std::size_t size = 0;  ///< bytes of one element; for text four per character
  bool big_endian = false;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
  std::string description;  ///< dtype and shape for messages, as in "float64 (3, 2)"
};

/// Parses `text`, a header's dictionary, of a file called `name`. Errors (input): it is not understood, or
/// claims more than is possible.
Result<NpyHeader> parseNpyHeader(std::string_view text, const std::string& name);

/// Bytes of all elements; parseNpyHeader() has checked that they are below 2^63.
std::uint64_t dataBytes(const NpyHeader& header);

/// Reads the header of `file` and leaves it at the first element. Errors (input): this is no .npy file, the
/// header is truncated or not understood, elements are text, the file has fewer or more bytes than the header
/// requires.
Result<NpyHeader> readNpyHeader(InputFile& file);

}  // namespace vorpipe
