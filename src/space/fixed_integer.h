/// Integers of a fixed number of 64-bit words, in two's complement. Nothing is checked: who uses them proves
/// that their numbers fit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vorpipe::space {

__extension__ using Int128 = __int128;
__extension__ using Word128 = unsigned __int128;

template <std::size_t words>
struct FixedInteger {
  std::array<std::uint64_t, words> word{};

  FixedInteger& operator+=(const FixedInteger& other) {
    std::uint64_t carry = 0;
    for (std::size_t k = 0; k < words; ++k) {
      const Word128 sum = static_cast<Word128>(word[k]) + other.word[k] + carry;
      word[k] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64U);
    }
    return *this;
  }
  FixedInteger operator-() const {
    FixedInteger negated;
    std::uint64_t carry = 1;
    for (std::size_t k = 0; k < words; ++k) {
      const Word128 sum = static_cast<Word128>(~word[k]) + carry;
      negated.word[k] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64U);
    }
    return negated;
  }
  FixedInteger& operator-=(const FixedInteger& other) { return *this += -other; }
  friend FixedInteger operator+(FixedInteger a, const FixedInteger& b) { return a += b; }
  friend FixedInteger operator-(FixedInteger a, const FixedInteger& b) { return a -= b; }

  [[nodiscard]] int sign() const {
    if (word[words - 1] >> 63U) return -1;
    std::uint64_t any = 0;
    for (const auto w : word) any |= w;
    return any ? 1 : 0;
  }
};

/// a b, |b| < 2^62.
inline FixedInteger<3> product(Int128 a, std::int64_t b) {
  const Int128 low = static_cast<Int128>(static_cast<std::uint64_t>(a)) * b;  // of less than 2^126
  const Int128 high = (a >> 64) * b + (low >> 64);
  const auto word = [](Int128 number) { return static_cast<std::uint64_t>(number); };
  return {{word(low), word(high), word(high >> 64)}};
}

/// a b. Words are multiplied as if they had no sign; 2^192 and 2^128 times the other are what that adds where
/// a, b are negative.
inline FixedInteger<5> product(const FixedInteger<3>& a, Int128 b) {
  const std::array<std::uint64_t, 2> right{static_cast<std::uint64_t>(b),
                                           static_cast<std::uint64_t>(b >> 64)};
  FixedInteger<5> result;
  for (std::size_t i = 0; i < 2; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const Word128 sum = static_cast<Word128>(a.word[j]) * right[i] + result.word[i + j] + carry;
      result.word[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64U);
    }
    result.word[i + 3] = carry;
  }
  if (a.sign() < 0) result -= {{0, 0, 0, right[0], right[1]}};
  if (b < 0) result -= {{0, 0, a.word[0], a.word[1], a.word[2]}};
  return result;
}

}  // namespace vorpipe::space
