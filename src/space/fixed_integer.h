/// Integers of a fixed number of 64-bit words, in two's complement. Nothing is checked: who uses them proves
/// that their numbers fit.
#pragma once

#include <array>
#include <bit>
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
  FixedInteger& operator-=(const FixedInteger& other) { return subtract(other, ~std::uint64_t{0}); }
  /// Subtracts those bits of each word of the other that are set in `mask`.
  FixedInteger& subtract(const FixedInteger& other, std::uint64_t mask) {
    std::uint64_t borrow = 0;
    for (std::size_t k = 0; k < words; ++k) {
      const Word128 less = static_cast<Word128>(word[k]) - (other.word[k] & mask) - borrow;
      word[k] = static_cast<std::uint64_t>(less);
      borrow = static_cast<std::uint64_t>(less >> 64U) & 1U;
    }
    return *this;
  }
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

/// a b. Words are multiplied as if they had no sign; 2^(64 words) and 2^128 times the other are what that
/// adds where a, b are negative.
template <std::size_t words>
[[gnu::always_inline]] inline FixedInteger<words + 2> product(const FixedInteger<words>& a, Int128 b) {
  const std::array<std::uint64_t, 2> right{static_cast<std::uint64_t>(b),
                                           static_cast<std::uint64_t>(b >> 64)};
  FixedInteger<words + 2> result;
  for (std::size_t i = 0; i < 2; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < words; ++j) {
      const Word128 sum = static_cast<Word128>(a.word[j]) * right[i] + result.word[i + j] + carry;
      result.word[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64U);
    }
    result.word[i + words] = carry;
  }
  // All bits if it is negative. Signs cannot be foreseen: no branch.
  const auto isNegative = [](std::uint64_t leading) { return std::uint64_t{0} - (leading >> 63U); };
  FixedInteger<words + 2> shifted;
  shifted.word[words] = right[0];
  shifted.word[words + 1] = right[1];
  result.subtract(shifted, isNegative(a.word[words - 1]));
  shifted = {};
  for (std::size_t j = 0; j < words; ++j) shifted.word[j + 2] = a.word[j];
  return result.subtract(shifted, isNegative(right[1]));
}

/// The number of the last bit of a positive number that is set: 0 is the first.
template <std::size_t words>
int lastBit(const FixedInteger<words>& a) {
  std::size_t k = words - 1;
  while (a.word[k] == 0) --k;
  return static_cast<int>(64 * k) + 63 - std::countl_zero(a.word[k]);
}

template <std::size_t words>
FixedInteger<words> shiftedLeft(const FixedInteger<words>& a, int bits) {
  FixedInteger<words> shifted;
  const std::size_t whole = static_cast<std::size_t>(bits) / 64;
  const int rest = bits % 64;
  for (std::size_t k = words; k-- > whole;) {
    const std::uint64_t below = rest != 0 && k > whole ? a.word[k - whole - 1] >> (64 - rest) : 0;
    shifted.word[k] = a.word[k - whole] << rest | below;
  }
  return shifted;
}

/// The quotient of positive numbers, rounded down, whose last bits are set: of 64 bits, or 65.
template <std::size_t words>
Word128 leadingQuotient(FixedInteger<words + 1> a, const FixedInteger<words>& b) {
  // a -= part b 2^(64 shift), as far as words go; returns whether it was too much.
  const auto subtract = [&](std::uint64_t part, std::size_t shift) {
    std::uint64_t carry = 0;
    bool borrow = false;
    const auto take = [&](std::uint64_t& word, std::uint64_t less) {
      const std::uint64_t before = word, after = before - less - (borrow ? 1 : 0);
      borrow = borrow ? before <= less : before < less;
      word = after;
    };
    for (std::size_t k = 0; k < words; ++k) {
      const Word128 sum = static_cast<Word128>(b.word[k]) * part + carry;
      take(a.word[k + shift], static_cast<std::uint64_t>(sum));
      carry = static_cast<std::uint64_t>(sum >> 64U);
    }
    if (shift == 0) take(a.word[words], carry);
    return borrow;
  };
  const auto addBack = [&](std::size_t shift) {
    bool carry = false;
    for (std::size_t k = 0; k < words; ++k) {
      const Word128 sum = static_cast<Word128>(a.word[k + shift]) + b.word[k] + (carry ? 1 : 0);
      a.word[k + shift] = static_cast<std::uint64_t>(sum);
      carry = sum >> 64U != 0;
    }
    if (shift == 0 && carry) carry = ++a.word[words] == 0;
    return carry;
  };
  const bool is_more = !subtract(1, 1);
  if (!is_more) addBack(1);
  // From the two leading words, and one: too much by 2 at most (Knuth, volume 2, 4.3.1).
  const Word128 leading = static_cast<Word128>(a.word[words]) << 64U | a.word[words - 1];
  const std::uint64_t first = b.word[words - 1];
  std::uint64_t digits =
      a.word[words] >= first ? ~std::uint64_t{0} : static_cast<std::uint64_t>(leading / first);
  if (subtract(digits, 0)) {
    do --digits;
    while (!addBack(0));
  }
  return static_cast<Word128>(is_more ? 1 : 0) << 64U | digits;
}

}  // namespace vorpipe::space
