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

/// Writes what `put(bytes, index)` appends for each index below `count`, through a buffer that is handed
/// on when it is full. Error (device): writing failed.
template <class Put>
Result<void> writeEach(ByteSink& sink, std::size_t count, const Put& put) {
  constexpr std::size_t full = std::size_t{1} << 16;
  Bytes bytes;
  for (std::size_t i = 0; i < count; ++i) {
    put(bytes, i);
    if (bytes.size() >= full || i + 1 == count) {
      if (auto written = sink.write({bytes.data(), bytes.size()}); !written) {
        return written;
      }
      bytes.clear();
    }
  }
  return {};
}

}  // namespace vorpipe
