#include "io/base/zip_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <vector>

#include "base/try.h"
#include "io/base/byte_order.h"

// APPNOTE.TXT, the format's description by PKWARE, version 6.3.10: sections 4.3.7 (header of an
// entry), 4.3.12 (its record in the directory), 4.3.14 to 4.3.16 (the end), 4.5.3 (the extra field of Zip64).

namespace vorpipe {
namespace {

/// Marks a field of 16 or 32 bits whose value is elsewhere, in 64 bits.
constexpr std::uint16_t elsewhere_16 = 0xFFFF;
constexpr std::uint32_t elsewhere_32 = 0xFFFFFFFF;
/// Format versions that a reader must support, without and with Zip64.
constexpr std::uint16_t plain_version = 10, zip64_version = 45;
/// Made on Unix, by a program that supports version 6.3.
constexpr std::uint16_t made_by = 3 << 8 | 63;

/// Directory data of an entry besides its name.
struct EntryRecord {
  std::uint64_t begin;  ///< position of its header in the archive
  std::uint64_t size;   ///< of head and body
  std::uint32_t checksum;
};

/// Appends numbers, each in the size of its type.
template <class... Numbers>
void put(std::string& bytes, Numbers... numbers) {
  (appendNumber<std::endian::little>(bytes, numbers), ...);
}

std::uint32_t narrow32(std::uint64_t value) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(value, elsewhere_32));
}

std::uint16_t narrow16(std::uint64_t value) {
  return static_cast<std::uint16_t>(std::min<std::uint64_t>(value, elsewhere_16));
}

bool isWide(std::uint64_t value) { return value >= elsewhere_32; }

/// Returns the Zip64 extra field with those numbers; empty if there are none.
std::string zip64Field(std::span<const std::uint64_t> numbers) {
  constexpr std::uint16_t zip64_tag = 1;
  std::string field;
  if (numbers.empty()) return field;
  put(field, zip64_tag, static_cast<std::uint16_t>(numbers.size_bytes()));
  for (const std::uint64_t number : numbers) put(field, number);
  return field;
}

/// Appends the part common to header and directory, from the version to the lengths of the name and of
/// `extra`.
void putCommon(std::string& bytes, const std::string& name, const EntryRecord& record,
               const std::string& extra) {
  constexpr std::uint16_t no_flags = 0, stored = 0, midnight = 0, first_of_january_1980 = 0x21;
  assert(name.size() < elsewhere_16);
  put(bytes, extra.empty() ? plain_version : zip64_version, no_flags, stored, midnight, first_of_january_1980,
      record.checksum, narrow32(record.size), narrow32(record.size), static_cast<std::uint16_t>(name.size()),
      static_cast<std::uint16_t>(extra.size()));
}

/// Returns the header before an entry.
std::string headerOf(const std::string& name, const EntryRecord& record) {
  constexpr std::uint32_t signature = 0x04034B50;
  const std::array sizes{record.size, record.size};
  const std::string extra = isWide(record.size) ? zip64Field(sizes) : std::string();
  std::string header;
  put(header, signature);
  putCommon(header, name, record, extra);
  return header + name + extra;
}

/// Returns an entry's directory record; the extra field holds only the wide values.
std::string directoryRecord(const std::string& name, const EntryRecord& record) {
  constexpr std::uint32_t signature = 0x02014B50, regular_file = 0100666u << 16;
  constexpr std::uint16_t no_comment = 0, disk = 0, no_attributes = 0;
  std::vector<std::uint64_t> wide;
  if (isWide(record.size)) wide.insert(wide.end(), {record.size, record.size});
  if (isWide(record.begin)) wide.push_back(record.begin);
  const std::string extra = zip64Field(wide);
  std::string bytes;
  put(bytes, signature, made_by);
  putCommon(bytes, name, record, extra);
  put(bytes, no_comment, disk, no_attributes, regular_file, narrow32(record.begin));
  return bytes + name + extra;
}

/// Returns the end of an archive, placed at `end`: its directory has `records` records, from `begin` to
/// `end`.
std::string endOf(std::uint64_t records, std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint32_t zip64_signature = 0x06064B50, locator_signature = 0x07064B50,
                          signature = 0x06054B50, disk = 0, disks = 1;
  constexpr std::uint16_t short_disk = 0, no_comment = 0;
  const std::uint64_t size = end - begin;
  std::string bytes;
  if (records >= elsewhere_16 || isWide(size) || isWide(begin)) {
    constexpr std::uint64_t rest_of_record = 44;
    put(bytes, zip64_signature, rest_of_record, made_by, zip64_version, disk, disk, records, records, size,
        begin);
    put(bytes, locator_signature, disk, end, disks);
  }
  put(bytes, signature, short_disk, short_disk, narrow16(records), narrow16(records), narrow32(size),
      narrow32(begin), no_comment);
  return bytes;
}

/// Calls `use(bytes)` with the pieces of an entry, in order, until one is refused.
template <class Use>
Result<void> eachPiece(const ZipEntry& entry, const Use& use) {
  Result<void> used = use(std::string_view(entry.head));
  std::array<char, std::size_t{1} << 16> piece;
  for (std::uint64_t offset = 0; used && offset < entry.body.size;) {
    const std::size_t count = entry.body.read(offset, piece.data(), piece.size());
    assert(count > 0);
    used = use(std::string_view(piece.data(), count));
    offset += count;
  }
  return used;
}

/// Computes the checksum beforehand: a reader of a pipe has no directory yet, and needs it in the header,
/// before the bytes.
std::uint32_t checksumOf(const ZipEntry& entry) {
  uLong checksum = 0;
  const auto add = [&](std::string_view bytes) -> Result<void> {
    checksum = crc32_z(checksum, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    return {};
  };
  // This callback refuses nothing.
  static_cast<void>(eachPiece(entry, add));
  return static_cast<std::uint32_t>(checksum);
}

}  // namespace

ZipBody zipBody(std::string_view bytes) {
  return {bytes.size(), [bytes](std::uint64_t offset, char* to, std::size_t length) {
            return bytes.copy(to, length, offset);
          }};
}

Result<void> writeZip(ByteSink& sink, std::span<const ZipEntry> entries) {
  assert(!entries.empty());
  std::uint64_t end = 0;
  const auto write = [&](std::string_view bytes) {
    end += bytes.size();
    return sink.write(bytes);
  };
  std::vector<EntryRecord> records;
  records.reserve(entries.size());
  for (const ZipEntry& entry : entries) {
    records.push_back({end, entry.head.size() + entry.body.size, checksumOf(entry)});
    auto written = write(headerOf(entry.name, records.back()));
    if (written) written = eachPiece(entry, write);
    if (!written) return written;
  }
  const std::uint64_t directory = end;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    VORPIPE_TRY(write(directoryRecord(entries[i].name, records[i])));
  }
  return sink.write(endOf(records.size(), directory, end));
}

}  // namespace vorpipe
