#include "io/arrays/zip_file.h"

#include <fmt/core.h>
#include <zip.h>

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "io/arrays/zip_plan.h"
#include "io/files/error.h"

namespace vorpipe {
namespace {

/// What libzip reads an entry from.
struct EntryReader {
  ZipPlan* plan;
  const ZipEntry* entry;
  std::uint64_t position = 0;
  zip_error_t error{};

  std::uint64_t read(char* to, std::uint64_t length) {
    plan->reading = entry;
    const std::uint64_t head = entry->head.size();
    std::size_t count = 0;
    if (position < head) {
      count = entry->head.copy(to, length, position);
    } else if (position - head < entry->body.size && length > 0) {
      count = entry->body.read(position - head, to, length);
    }
    position += count;
    return count;
  }
};

/// zip_source_callback of an EntryReader.
zip_int64_t onEntry(void* user, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  auto& reader = *static_cast<EntryReader*>(user);
  switch (command) {
    case ZIP_SOURCE_SUPPORTS:
      return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE,
                                            ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
    case ZIP_SOURCE_OPEN:
      reader.position = 0;
      return 0;
    case ZIP_SOURCE_READ:
      return static_cast<zip_int64_t>(reader.read(static_cast<char*>(data), length));
    case ZIP_SOURCE_CLOSE:
      reader.plan->reading = nullptr;
      return 0;
    case ZIP_SOURCE_STAT:
      return zipStatOf(reader.entry->head.size() + reader.entry->body.size, data);
    case ZIP_SOURCE_ERROR:
      return zip_error_to_data(&reader.error, data, length);
    case ZIP_SOURCE_FREE:
      return 0;
    default:
      zip_error_set(&reader.error, ZIP_ER_OPNOTSUPP, 0);
      return -1;
  }
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

Archive openPlan(ZipPlan& plan, zip_error_t& error) {
  zip_source_t* const target = zip_source_function_create(onZipPlan, &plan, &error);
  if (target == nullptr) {
    return nullptr;
  }
  Archive archive(zip_open_from_source(target, ZIP_CREATE | ZIP_TRUNCATE, &error));
  if (!archive) {
    zip_source_free(target);
  }
  return archive;
}

bool addEntry(zip_t* archive, EntryReader& reader) {
  constexpr zip_uint16_t midnight = 0, first_of_january_1980 = 0x21;
  zip_source_t* const source = zip_source_function(archive, onEntry, &reader);
  if (source == nullptr) {
    return false;
  }
  const zip_int64_t index = zip_file_add(archive, reader.entry->name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    return false;
  }
  const auto number = static_cast<zip_uint64_t>(index);
  return zip_set_file_compression(archive, number, ZIP_CM_STORE, 0) == 0 &&
         zip_file_set_dostime(archive, number, midnight, first_of_january_1980, 0) == 0;
}

/// The error is in libzip's words.
tl::expected<void, std::string> makePlan(ZipPlan& plan, std::span<const ZipEntry> entries) {
  std::vector<EntryReader> readers;
  readers.reserve(entries.size());
  zip_error_t error;
  zip_error_init(&error);
  Archive archive = openPlan(plan, error);
  if (!archive) {
    return tl::unexpected<std::string>(zip_error_strerror(&error));
  }
  for (const ZipEntry& entry : entries) {
    readers.push_back({&plan, &entry});
    if (!addEntry(archive.get(), readers.back())) {
      return tl::unexpected<std::string>(zip_strerror(archive.get()));
    }
  }
  if (zip_close(archive.get()) != 0) {
    return tl::unexpected<std::string>(zip_strerror(archive.get()));
  }
  std::ignore = archive.release();  // zip_close has freed it
  return {};
}

Result<void> writePiece(ByteSink& sink, const ZipPiece& piece) {
  if (piece.entry == nullptr) {
    return sink.write(piece.bytes);
  }
  if (auto written = sink.write(piece.entry->head); !written) {
    return written;
  }
  std::array<char, std::size_t{1} << 16> chunk;
  const ZipBody& body = piece.entry->body;
  for (std::uint64_t offset = 0; offset < body.size;) {
    const std::size_t count = body.read(offset, chunk.data(), chunk.size());
    if (auto written = sink.write({chunk.data(), count}); !written) {
      return written;
    }
    offset += count;
  }
  return {};
}

}  // namespace

ZipBody zipBody(std::string_view bytes) {
  return {bytes.size(), [bytes](std::uint64_t offset, char* to, std::size_t length) {
            return bytes.copy(to, length, offset);
          }};
}

Result<void> writeZip(ByteSink& sink, std::span<const ZipEntry> entries) {
  assert(!entries.empty());
  ZipPlan plan;
  if (const auto made = makePlan(plan, entries); !made) {
    return deviceError(fmt::format("{}: could not be made a zip archive: {}", sink.name(), made.error()));
  }
  std::uint64_t end = 0;
  for (const auto& [begin, piece] : plan.pieces) {
    if (begin != end) {
      return deviceError(
          fmt::format("{}: this libzip writes archives in an order that is not understood; "
                      "another version of it is needed",
                      sink.name()));
    }
    if (auto written = writePiece(sink, piece); !written) {
      return written;
    }
    end += piece.size();
  }
  return {};
}

}  // namespace vorpipe
