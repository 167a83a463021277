/// Numbers as bytes of a given order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "io/cells/cell_records.h"

namespace vorpipe {

/// Appends a number's bytes in the order given.
template <std::endian order, class Number>
void appendNumber(Bytes& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if constexpr (order != std::endian::native) {
    std::reverse(raw.begin(), raw.end());
  }
  bytes.append(raw.data(), raw.data() + raw.size());
}

}  // namespace vorpipe
