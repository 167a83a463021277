/// A zip archive before it is written.
///
/// libzip writes an entry's header, its data, and then the header again with the checksum. A ByteSink,
/// which may be a pipe, has no way back. So libzip writes into a plan, which keeps the headers and, of an
/// entry's data, only the place; the file is then written out of the plan from its beginning to its end.
#pragma once

#include <zip.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "io/arrays/zip_file.h"

namespace vorpipe {

/// Bytes that libzip made, or one whole entry.
struct ZipPiece {
  std::string bytes;
  const ZipEntry* entry = nullptr;

  [[nodiscard]] std::uint64_t size() const {
    return entry != nullptr ? entry->head.size() + entry->body.size : bytes.size();
  }
};

struct ZipPlan {
  std::map<std::uint64_t, ZipPiece> pieces;  ///< by offset in the archive
  std::uint64_t position = 0;                ///< where libzip writes next
  const ZipEntry* reading = nullptr;         ///< the entry whose data libzip copies now
  zip_error_t error{};

  void write(std::string_view bytes);
  [[nodiscard]] std::uint64_t size() const;
};

/// zip_source_callback of a ZipPlan, `user`, which libzip takes for an empty archive.
zip_int64_t onZipPlan(void* user, void* data, zip_uint64_t length, zip_source_cmd_t command);

/// zip_source_callback's answer to ZIP_SOURCE_STAT: only the size is known.
zip_int64_t zipStatOf(zip_uint64_t size, void* data);

}  // namespace vorpipe
