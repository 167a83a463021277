/// Zip archives of files that are in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Bytes that are in memory or made on demand.
struct ZipBody {
  std::uint64_t size = 0;
  /// Copies bytes, starting at `offset`, to `to`, at most `length` of them and at least one; returns how
  /// many.
  std::function<std::size_t(std::uint64_t offset, char* to, std::size_t length)> read;
};

/// A body of bytes that must stay in place.
ZipBody zipBody(std::string_view bytes);

/// A file inside an archive: `head`, then `body`, which is read twice. The name is in ASCII.
struct ZipEntry {
  std::string name;
  std::string head;
  ZipBody body;
};

/// Writes an archive of at least one entry, stored without compression and with a fixed time, so that equal
/// entries give equal bytes. Uses Zip64 only if a size, an offset or the number of entries requires it. Takes
/// 24 bytes of memory for each entry (decision D91). Error (device): writing failed.
Result<void> writeZip(ByteSink& sink, std::span<const ZipEntry> entries);

}  // namespace vorpipe
