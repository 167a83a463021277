/// Arrays in memory as .npy files.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vorpipe {

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
