/// Bytes that are taken for numbers and choices, one after the other; zeros behind their end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace vorpipe::fuzz {

class ByteStream {
 public:
  explicit ByteStream(std::string_view bytes) : rest_(bytes) {}

  [[nodiscard]] bool atEnd() const { return rest_.empty(); }

  template <class Number>
  Number take() {
    Number number{};
    const std::size_t count = std::min(sizeof number, rest_.size());
    std::memcpy(&number, rest_.data(), count);
    rest_.remove_prefix(count);
    return number;
  }

  /// Below `end`.
  std::size_t choice(std::size_t end) { return take<std::uint8_t>() % end; }
  bool flag() { return choice(2) == 1; }

  /// A coordinate: mostly of a small lattice, where ties are; else any double, numbers that are none among
  /// them.
  double number() {
    constexpr double step = 1.0 / 16;
    const auto kind = take<std::uint8_t>();
    if (kind < 160) return (kind % 33 - 8) * step;
    if (kind < 200) return kind % 17 * step + take<std::int8_t>() * 0x1p-50;
    if (kind < 240) return take<std::int16_t>() * 0x1p-14;
    return take<double>();
  }

 private:
  std::string_view rest_;
};

}  // namespace vorpipe::fuzz
