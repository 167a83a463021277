/// Text and numbers that are collected before a sink gets them.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "io/files/byte_sink.h"

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

/// Hands on what has been collected. Error (device): writing failed.
inline Result<void> writeAll(ByteSink& sink, Bytes& bytes) {
  auto written = sink.write({bytes.data(), bytes.size()});
  bytes.clear();
  return written;
}

/// The same once there is enough of it for a call.
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
