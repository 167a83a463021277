#include "io/base/npz_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <new>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/inflater.h"
#include "io/base/input_file.h"
#include "io/base/memory_room.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

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

std::uint64_t checksumOf(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

/// Inflates raw deflate data; none if they are damaged or have another size.
std::optional<std::string> inflated(std::string_view packed, std::size_t size) {
  if (size / Inflater::largest_ratio > packed.size()) return std::nullopt;
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

Result<NpzFile> NpzFile::read(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  // A file that is no archive is not read to its end: it may have none.
  std::string bytes(local_mark.size(), '\0');
  const auto begin = file->read(bytes);
  if (!begin) return tl::unexpected(begin.error());
  if (bytes != local_mark) return inputError(path + ": it is no whole .npz file");
  auto rest = readText(*file);
  if (!rest) return tl::unexpected(std::move(rest.error()));
  bytes += *rest;
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
    if (checksumOf(array) != numberAt(bytes, at + 16, 4)) {
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
  auto header = parseNpyHeader(array.substr(begin, length), fmt::format("{}: {}", name_, printable(name)));
  if (!header) return tl::unexpected(std::move(header.error()));
  const std::string_view elements = array.substr(begin + length);
  if (dataBytes(*header) != elements.size()) return broken();
  entries_.insert_or_assign(std::string(name), NpzEntry{std::move(*header), elements});
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
