#include "io/base/zip_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/print.h"
#include "io/base/quoted.h"

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
  VORPIPE_TRY(use(std::string_view(entry.head)));
  std::array<char, std::size_t{1} << 16> piece;
  for (std::uint64_t offset = 0; offset < entry.body.size;) {
    const std::size_t count = entry.body.read(offset, piece.data(), piece.size());
    assert(count > 0);
    VORPIPE_TRY(use(std::string_view(piece.data(), count)));
    offset += count;
  }
  return {};
}

/// Returns the checksum of bytes after others that have the checksum `before`.
std::uint32_t crcOf(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Computes the checksum beforehand: a reader of a pipe has no directory yet, and needs it in the header,
/// before the bytes.
std::uint32_t checksumOf(const ZipEntry& entry) {
  std::uint32_t checksum = 0;
  const auto add = [&](std::string_view bytes) -> Result<void> {
    checksum = crcOf(bytes, checksum);
    return {};
  };
  // This callback refuses nothing.
  static_cast<void>(eachPiece(entry, add));
  return checksum;
}

/// First bytes of an archive, and of each file in it.
constexpr std::string_view local_mark = "PK\3\4";

/// A number of `size` bytes, the lowest first; 0 beyond the end.
std::uint64_t numberAt(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t k = size; k-- > 0;) {
    const char byte = at + k < bytes.size() ? bytes[at + k] : '\0';
    number = number << 8 | static_cast<unsigned char>(byte);
  }
  return number;
}

/// Inflates raw deflate data; none if they are damaged or have another size.
std::optional<std::string> inflated(std::string_view packed, std::size_t size) {
  if (size / largest_inflation > packed.size()) return std::nullopt;
  std::string bytes(size, '\0');
  z_stream stream{};
  // No zlib header, since archives have their own.
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(size);
  const int code = inflate(&stream, Z_FINISH);
  const bool is_whole = code == Z_STREAM_END && stream.avail_out == 0;
  inflateEnd(&stream);
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
  return is_whole ? std::optional(std::move(bytes)) : std::nullopt;
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
    VORPIPE_TRY(write(headerOf(entry.name, records.back())));
    VORPIPE_TRY(eachPiece(entry, write));
  }
  const std::uint64_t directory = end;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    VORPIPE_TRY(write(directoryRecord(entries[i].name, records[i])));
  }
  return sink.write(endOf(records.size(), directory, end));
}

Result<NpzFile> NpzFile::read(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  // A file that is no archive is not read to its end: it may have none.
  std::string bytes(local_mark.size(), '\0');
  const auto begin = file.read(bytes);
  if (!begin) return tl::unexpected(begin.error());
  if (bytes != local_mark) return inputError(path + ": it is no whole .npz file");
  VORPIPE_VAR(rest, readText(file));
  bytes += rest;
  NpzFile npz(path);
  try {
    const std::string& archive = npz.bytes_.emplace_back(std::move(bytes));
    VORPIPE_TRY(npz.index(archive));
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its arrays");
  }
  return npz;
}

/// Walks the directory at the archive's end (APPNOTE.TXT 4.3.12 and 4.3.16; no Zip64 sizes, which begin at
/// 4 GiB).
Result<void> NpzFile::index(std::string_view bytes) {
  constexpr std::string_view end_mark = "PK\5\6", entry_mark = "PK\1\2";
  constexpr std::uint64_t stored = 0, deflated = 8;
  const auto broken = [&] { return inputError(fmt::format("{}: it is no whole .npz file", name_)); };
  const std::size_t end = bytes.rfind(end_mark);
  if (end == std::string_view::npos) return broken();
  const std::uint64_t count = numberAt(bytes, end + 10, 2);
  std::size_t at = numberAt(bytes, end + 16, 4);
  for (std::uint64_t k = 0; k < count; ++k) {
    if (at + 46 > bytes.size() || bytes.substr(at, 4) != entry_mark) return broken();
    const std::uint64_t method = numberAt(bytes, at + 10, 2);
    const std::uint64_t packed = numberAt(bytes, at + 20, 4), size = numberAt(bytes, at + 24, 4);
    const std::size_t name_size = numberAt(bytes, at + 28, 2);
    const std::size_t local = numberAt(bytes, at + 42, 4);
    const std::string_view name = bytes.substr(at + 46, name_size);
    if (method != stored && method != deflated) {
      return inputError(fmt::format("{}: {} is compressed otherwise than NumPy does", name_, inQuotes(name)));
    }
    if (local + 30 > bytes.size() || bytes.substr(local, 4) != local_mark) return broken();
    const std::size_t begin = local + 30 + numberAt(bytes, local + 26, 2) + numberAt(bytes, local + 28, 2);
    if (begin > bytes.size() || packed > bytes.size() - begin) return broken();
    std::string_view array = bytes.substr(begin, packed);
    if (method == deflated) {
      VORPIPE_TRY(checkRoom(name_, "arrays", size));
      auto whole = inflated(array, size);
      if (!whole) return inputError(fmt::format("{}: {} is damaged", name_, inQuotes(name)));
      array = bytes_.emplace_back(std::move(*whole));
    }
    if (crcOf(array) != numberAt(bytes, at + 16, 4)) {
      return inputError(fmt::format("{}: {} is damaged: its checksum is another", name_, inQuotes(name)));
    }
    VORPIPE_TRY(add(name, array));
    at += 46 + name_size + numberAt(bytes, at + 30, 2) + numberAt(bytes, at + 32, 2);
  }
  return {};
}

Result<void> NpzFile::add(std::string_view name, std::string_view array) {
  constexpr std::string_view extension = ".npy";
  if (name.ends_with(extension)) name.remove_suffix(extension.size());
  const auto broken = [&] {
    return inputError(fmt::format("{}: {} is no array that is understood", name_, inQuotes(name)));
  };
  if (!array.starts_with(npy_magic) || array.size() < 12) return broken();
  const std::size_t length_size = array[npy_magic.size()] == 1 ? 2 : 4;
  const std::size_t begin = npy_magic.size() + 2 + length_size;
  const std::size_t length = numberAt(array, npy_magic.size() + 2, length_size);
  if (length > array.size() - begin) return broken();
  VORPIPE_VAR(header,
              parseNpyHeader(array.substr(begin, length), fmt::format("{}: {}", name_, printable(name))));
  const std::string_view elements = array.substr(begin + length);
  if (header.data_bytes != elements.size()) return broken();
  entries_.insert_or_assign(std::string(name), NpzEntry{std::move(header), elements});
  return {};
}

std::vector<std::string> NpzFile::names() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

Result<const NpzEntry*> NpzFile::entryOf(const std::string& name, std::uint64_t columns) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return nullptr;
  const NpyHeader& header = found->second.header;
  const bool fits = columns == 1 || (header.shape.size() == 2 && header.shape[1] == columns);
  if (!areNumbers(header) || !fits) {
    return inputError(fmt::format("{}: {} is {}, not numbers{}", name_, name, header.description,
                                  columns == 1 ? "" : fmt::format(" (N, {})", columns)));
  }
  return &found->second;
}

Error NpzFile::notHeld(const std::string& name, std::uint64_t index, std::string_view type) const {
  return {ErrorCode::input, fmt::format("{}: {}: element {} (counted from 0) is no number of type {}", name_,
                                        name, index, type)};
}

std::optional<std::string> NpzFile::text(const std::string& name) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return std::nullopt;
  const auto& [header, elements] = found->second;
  if (header.kind != 'U' || elements.size() != header.size) return std::nullopt;
  std::string text;
  for (std::size_t at = 0; at < elements.size(); at += sizeof(std::uint32_t)) {
    const auto character = valueOf<std::uint32_t>(elements.data() + at, header.big_endian);
    // Zeros are padding; non-ASCII characters occur in no name.
    if (character != 0) text += character < 0x80 ? static_cast<char>(character) : '?';
  }
  return text;
}

}  // namespace vorpipe
