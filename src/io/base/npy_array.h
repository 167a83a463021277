/// Arrays as NumPy's .npy files, versions 1 to 3.
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
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
  std::uint64_t data_bytes = 0;  ///< of all elements, below 2^63
  std::string description;       ///< dtype and shape for messages, as in "float64 (3, 2)"
};

/// Parses `text`, a header's dictionary, of a file called `name`. Errors (input): it is not understood, or
/// claims more than is possible.
Result<NpyHeader> parseNpyHeader(std::string_view text, const std::string& name);

/// Reads the header of `file` and leaves it at the first element. Errors (input): this is no .npy file, the
/// header is truncated or not understood, elements are text, the file has fewer or more bytes than the header
/// requires.
Result<NpyHeader> readNpyHeader(InputFile& file);

/// Returns `bytes` as one Value in the given byte order.
template <class Value>
Value valueOf(const char* bytes, bool big_endian) {
  char native[sizeof(Value)];
  std::memcpy(native, bytes, sizeof(Value));
  if (big_endian != (std::endian::native == std::endian::big)) {
    std::reverse(native, native + sizeof(Value));
  }
  return std::bit_cast<Value>(native);
}

/// Calls `take(index, value)` for each of `count` elements in a row, through a buffer of fixed size;
/// take returns Result<void>, and its first error ends the reading. Error (input): the file ends first.
template <class Value, class Take>
Result<void> eachElement(InputFile& file, const NpyHeader& header, std::uint64_t count, Take take) {
  constexpr std::size_t chunk = std::size_t{1} << 16;
  std::vector<char> buffer(chunk * sizeof(Value));
  for (std::uint64_t first = 0; first < count; first += chunk) {
    const auto length = static_cast<std::size_t>(std::min<std::uint64_t>(chunk, count - first));
    VORPIPE_LET(got, file.read(std::span(buffer).first(length * sizeof(Value))));
    if (got < length * sizeof(Value)) {
      return inputError(file.name() + ": is truncated: its data end after " +
                        std::to_string(first * sizeof(Value) + got) + " of " +
                        std::to_string(count * sizeof(Value)) + " bytes");
    }
    for (std::size_t i = 0; i < length; ++i) {
      const auto value = valueOf<Value>(buffer.data() + i * sizeof(Value), header.big_endian);
      VORPIPE_TRY(take(first + i, value));
    }
  }
  // A file of unknown size, such as gzip, must be read to its end, where its checksum is.
  char more = 0;
  VORPIPE_LET(rest, file.read(std::span(&more, 1)));
  if (rest > 0) return inputError(file.name() + ": is too long: bytes follow the last element of its array");
  return {};
}

/// Whether eachNumber() takes the elements: NumPy's booleans and numbers, except float16, longdouble and
/// complex ones.
inline bool areNumbers(const NpyHeader& header) {
  const std::size_t size = header.size;
  if (header.kind == 'f') return size == sizeof(float) || size == sizeof(double);
  if (header.kind == 'b') return size == 1;
  return (header.kind == 'i' || header.kind == 'u') && std::has_single_bit(size) && size <= 8;
}

/// Calls `use(Value())` with the type of the elements; areNumbers() must hold.
template <class Use>
auto withType(const NpyHeader& header, Use use) {
  const std::size_t size = header.size;
  if (header.kind == 'f') return size == sizeof(float) ? use(float()) : use(double());
  if (header.kind == 'i') {
    return size == 1   ? use(std::int8_t())
           : size == 2 ? use(std::int16_t())
           : size == 4 ? use(std::int32_t())
                       : use(std::int64_t());
  }
  return size == 1   ? use(std::uint8_t())
         : size == 2 ? use(std::uint16_t())
         : size == 4 ? use(std::uint32_t())
                     : use(std::uint64_t());
}

/// Whether a double holds this number exactly; 64-bit integers beyond 2^53 count as inexact.
template <class Value>
bool isExact(Value value) {
  if constexpr (std::is_integral_v<Value> && sizeof(Value) == 8) {
    constexpr auto most = Value{1} << std::numeric_limits<double>::digits;
    return value <= most && (std::is_unsigned_v<Value> || value >= Value{0} - most);
  }
  return true;
}

/// eachElement() for any type of number; `take(index, value)` gets the numbers unconverted. Also an error
/// (input): a number that no double equals.
template <class Take>
Result<void> eachNumber(InputFile& file, const NpyHeader& header, std::uint64_t count, Take take) {
  return withType(header, [&]<class Value>(Value) {
    return eachElement<Value>(file, header, count, [&](std::uint64_t index, Value value) -> Result<void> {
      if (isExact(value)) return take(index, value);
      return inputError(file.name() + ": element " + std::to_string(index) + " (counted from 0) is " +
                        std::to_string(value) + ", above 2^53: no double is the same number");
    });
  });
}

/// Most pixels in a row or a column of an image array.
inline constexpr std::uint64_t max_extent = 1 << 20;

/// eachElement() for all elements of an array of two axes: `take(row, column, value)`.
template <class Value, class Take>
Result<void> eachPixel(InputFile& file, const NpyHeader& header, Take take) {
  const std::uint64_t rows = header.shape[0], columns = header.shape[1];
  return eachElement<Value>(file, header, rows * columns, [&](std::uint64_t index, Value value) {
    return header.fortran_order ? take(index % rows, index / rows, value)
                                : take(index / columns, index % columns, value);
  });
}

/// A .npy file in two parts; `elements` points into the source array, which must outlive it.
struct NpyArray {
  std::string header;
  std::string_view elements;
};

/// Header, version 1, of a C-order array of a NumPy dtype such as "<u4".
std::string npyHeader(std::string_view type, std::span<const std::uint64_t> shape);

/// The dtype of a number in this machine's byte order.
template <class Number>
std::string npyType() {
  const char order = sizeof(Number) == 1 ? '|' : std::endian::native == std::endian::little ? '<' : '>';
  const char kind = std::floating_point<Number> ? 'f' : std::signed_integral<Number> ? 'i' : 'u';
  return {order, kind, static_cast<char>('0' + sizeof(Number))};
}

/// `rows`, of `columns` numbers each, as an array of two dimensions, or of one if there is one column.
template <class Number, std::uint64_t columns, class Row>
NpyArray npyArray(std::span<const Row> rows) {
  static_assert(sizeof(Row) == columns * sizeof(Number));
  const std::uint64_t shape[] = {rows.size(), columns};
  return {npyHeader(npyType<Number>(), std::span(shape).first(columns == 1 ? 1 : 2)),
          {reinterpret_cast<const char*>(rows.data()), rows.size_bytes()}};
}

}  // namespace vorpipe
