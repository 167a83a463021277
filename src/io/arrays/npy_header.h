/// The header of NumPy's .npy files, versions 1 to 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/input_file.h"

namespace vorpipe {

/// What a .npy file begins with.
inline constexpr std::string_view npy_magic = "\x93NUMPY";

struct NpyHeader {
  char kind = 0;         ///< f: floating point, i: signed, u: unsigned
  std::size_t size = 0;  ///< bytes of one element
  bool big_endian = false;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
  std::string description;  ///< dtype and shape for messages, as in "float64 (3, 2)"
};

/// Reads the header of `file` and leaves it at the first element. Errors (input): this is no .npy file, the
/// header is truncated or says what is not understood, the file has fewer or more bytes than it asks for.
Result<NpyHeader> readNpyHeader(InputFile& file);

}  // namespace vorpipe
