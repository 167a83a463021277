/// Writes records of text or bytes, one after the other, to a file.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "io/base/byte_sink.h"
#include "vorpipe.h"

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

/// Bytes of a file before they are written.
using Bytes = fmt::memory_buffer;

/// Most characters that a value prints as: those of -2.2250738585072014e-308 for a number, its own for a
/// text.
template <class Value>
std::size_t longestText(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value>) {
    return 24;
  } else {
    return std::string_view(value).size();
  }
}

/// Appends text; `format` is a FMT_COMPILE, and a double prints as the shortest text that reads back to it.
/// No field is wider than 24 characters, so that a double is never written with a fixed number of decimals.
template <class Format, class... Values>
void print(Bytes& bytes, const Format& format, const Values&... values) {
  // Prints straight into enough memory: fmt would ask a buffer for room with each piece of a number.
  constexpr auto text = static_cast<fmt::string_view>(Format());
  constexpr auto fields = std::count(text.begin(), text.end(), '{');
  const auto size = bytes.size();
  bytes.resize(size + text.size() + fields * std::max({std::size_t{0}, longestText(values)...}));
  const char* const end = fmt::format_to(bytes.data() + size, format, values...);
  bytes.resize(static_cast<std::size_t>(end - bytes.data()));
}

/// Appends what `put(bytes, index)` appends for each index below `count`, `separator` between them.
template <class Put>
void join(Bytes& bytes, std::size_t count, std::string_view separator, const Put& put) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i != 0) {
      bytes.append(separator);
    }
    put(bytes, i);
  }
}

/// How a format writes a list.
struct ListText {
  std::string_view open, separator, close;
};

/// Appends a list of what `put(bytes, index)` appends for each index below `count`.
template <class Put>
void printList(Bytes& text, const ListText& list, std::size_t count, const Put& put) {
  text.append(list.open);
  join(text, count, list.separator, put);
  text.append(list.close);
}

/// Writes the collected bytes and clears them. Error (device): writing failed.
inline Result<void> writeAll(ByteSink& sink, Bytes& bytes) {
  auto written = sink.write({bytes.data(), bytes.size()});
  bytes.clear();
  return written;
}

/// The same, but only if there are enough bytes to be worth a call.
inline Result<void> writeIfFull(ByteSink& sink, Bytes& bytes) {
  constexpr std::size_t full = std::size_t{1} << 16;
  return bytes.size() < full ? Result<void>() : writeAll(sink, bytes);
}

/// Writes what `put(bytes, index)` appends for each index below `count`, except the first `skipped` bytes.
/// Calls put() on up to `threads` threads at once, 0 for all, and more than one block ahead of what has been
/// written. Error (device): writing failed.
template <class Put>
Result<void> writeEach(ByteSink& sink, std::size_t count, const Put& put, int threads = 1,
                       std::size_t skipped = 0) {
  constexpr std::size_t in_block = 256, blocks_per_thread = 4, worth_threads = 4096;
  if (count < worth_threads) threads = 1;
  const std::size_t blocks = blocks_per_thread * static_cast<std::size_t>(threadCount(threads));
  std::vector<Bytes> next(blocks), done(blocks);
  Result<void> written;
  const auto writeDone = [&] {
    for (Bytes& bytes : done) {
      const std::size_t from = std::min(skipped, bytes.size());
      skipped -= from;
      if (written) written = sink.write({bytes.data() + from, bytes.size() - from});
      bytes.clear();
    }
  };
  for (std::size_t first = 0; first < count && written; first += blocks * in_block) {
    // One thread writes the last round's blocks while the others fill the next ones.
    parallelFor(blocks + 1, 1, threads, [&](std::size_t task, std::size_t) {
      if (task == 0) return writeDone();
      const std::size_t begin = std::min(count, first + (task - 1) * in_block);
      for (auto i = begin; i < std::min(count, begin + in_block); ++i) put(next[task - 1], i);
    });
    std::swap(next, done);
  }
  if (written) writeDone();
  return written;
}

}  // namespace vorpipe
