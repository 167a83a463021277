/// Records of text or bytes, one after the other into a file.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "io/files/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Bytes of a file before they are written.
using Bytes = fmt::memory_buffer;

/// Appends text; `format` is a FMT_COMPILE, and a double prints as the shortest text that reads back to it.
template <class Format, class... Values>
void print(Bytes& bytes, const Format& format, const Values&... values) {
  fmt::format_to(fmt::appender(bytes), format, values...);
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

/// Hands on what has been collected. Error (device): writing failed.
inline Result<void> writeAll(ByteSink& sink, Bytes& bytes) {
  auto written = sink.write({bytes.data(), bytes.size()});
  bytes.clear();
  return written;
}

/// The same once there is enough of it to be worth a call.
inline Result<void> writeIfFull(ByteSink& sink, Bytes& bytes) {
  constexpr std::size_t full = std::size_t{1} << 16;
  return bytes.size() < full ? Result<void>() : writeAll(sink, bytes);
}

/// Writes what `put(bytes, index)` appends for each index below `count`, through a buffer that is handed
/// on when it is full. Error (device): writing failed.
template <class Put>
Result<void> writeEach(ByteSink& sink, std::size_t count, const Put& put) {
  Bytes bytes;
  for (std::size_t i = 0; i < count; ++i) {
    put(bytes, i);
    if (auto written = writeIfFull(sink, bytes); !written) return written;
  }
  return writeAll(sink, bytes);
}

}  // namespace vorpipe
