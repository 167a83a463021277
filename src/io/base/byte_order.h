/// Numbers as bytes of a given order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

namespace vorpipe {

/// Appends a number's bytes in the order given, to a string or another buffer of char.
template <std::endian order, class Buffer, class Number>
void appendNumber(Buffer& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if constexpr (order != std::endian::native) {
    std::reverse(raw.begin(), raw.end());
  }
  bytes.append(raw.data(), raw.data() + raw.size());
}

}  // namespace vorpipe
