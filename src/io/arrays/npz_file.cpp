#include "io/arrays/npz_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <charconv>
#include <numeric>
#include <utility>

#include "io/arrays/npy_header.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/text/quoted.h"

namespace vorpipe {
namespace {

/// What an archive begins with, and each file in it.
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

/// What a .npy header has after a key, up to `end`.
std::string_view valueOf(std::string_view header, std::string_view key, std::string_view end) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  header.remove_prefix(at + key.size());
  return header.substr(0, header.find(end));
}

std::optional<std::vector<std::uint64_t>> shapeOf(std::string_view text) {
  std::vector<std::uint64_t> shape;
  while (!text.empty()) {
    if (text.front() == ' ' || text.front() == ',') {
      text.remove_prefix(1);
      continue;
    }
    std::uint64_t length = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), length);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    shape.push_back(length);
  }
  return shape;
}

}  // namespace

Result<NpzFile> NpzFile::read(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  // What is no archive need not be read to its end, which it may not have.
  std::string bytes(local_mark.size(), '\0');
  const auto begin = file->read(bytes);
  if (!begin) return tl::unexpected(begin.error());
  if (bytes != local_mark) return inputError(path + ": it is no whole .npz file");
  auto rest = readText(*file);
  if (!rest) return tl::unexpected(std::move(rest.error()));
  bytes += *rest;
  NpzFile npz(path, std::move(bytes));
  if (auto indexed = npz.index(); !indexed) return tl::unexpected(std::move(indexed.error()));
  return npz;
}

/// Walks the directory at the archive's end (APPNOTE.TXT 4.3.12 and 4.3.16; no Zip64 sizes, which begin at
/// 4 GiB).
Result<void> NpzFile::index() {
  constexpr std::string_view end_mark = "PK\5\6", entry_mark = "PK\1\2";
  const std::string_view bytes = bytes_;
  const auto broken = [&] { return inputError(fmt::format("{}: it is no whole .npz file", name_)); };
  const std::size_t end = bytes.rfind(end_mark);
  if (end == std::string_view::npos) return broken();
  const std::uint64_t count = numberAt(bytes, end + 10, 2);
  std::size_t at = numberAt(bytes, end + 16, 4);
  for (std::uint64_t k = 0; k < count; ++k) {
    if (at + 46 > bytes.size() || bytes.substr(at, 4) != entry_mark) return broken();
    const std::uint64_t method = numberAt(bytes, at + 10, 2), size = numberAt(bytes, at + 24, 4);
    const std::size_t name_size = numberAt(bytes, at + 28, 2);
    const std::size_t local = numberAt(bytes, at + 42, 4);
    const std::string_view name = bytes.substr(at + 46, name_size);
    if (method != 0) {
      return inputError(fmt::format("{}: {} is compressed; numpy.savez does not", name_, inQuotes(name)));
    }
    if (local + 30 > bytes.size() || bytes.substr(local, 4) != local_mark) return broken();
    const std::size_t begin = local + 30 + numberAt(bytes, local + 26, 2) + numberAt(bytes, local + 28, 2);
    if (begin > bytes.size() || size > bytes.size() - begin) return broken();
    const std::string_view array = bytes.substr(begin, size);
    if (checksumOf(array) != numberAt(bytes, at + 16, 4)) {
      return inputError(fmt::format("{}: {} is damaged: its checksum is another", name_, inQuotes(name)));
    }
    if (auto added = add(name, array); !added) return added;
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
  const std::string_view header = array.substr(begin, length);
  NpzEntry entry;
  entry.type = valueOf(header, "'descr': '", "'");
  const auto shape = shapeOf(valueOf(header, "'shape': (", ")"));
  const bool c_order = valueOf(header, "'fortran_order': ", ",") == "False";
  if (entry.type.empty() || !shape) return broken();
  entry.shape = *shape;
  if (!c_order && entry.shape.size() > 1) return broken();
  entry.elements = array.substr(begin + length);
  entries_.insert_or_assign(std::string(name), std::move(entry));
  return {};
}

Result<std::string_view> NpzFile::elements(const std::string& name, const std::string& type,
                                           std::uint64_t columns) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return std::string_view();
  const NpzEntry& entry = found->second;
  const std::uint64_t count =
      std::accumulate(entry.shape.begin(), entry.shape.end(), std::uint64_t{1}, std::multiplies<>());
  const std::uint64_t size = static_cast<std::uint64_t>(type.back() - '0');
  const bool fits = columns == 1 || (entry.shape.size() == 2 && entry.shape[1] == columns);
  if (entry.type != type || !fits || count != entry.elements.size() / size) {
    return inputError(fmt::format("{}: {} is not of type {}{}", name_, name, type,
                                  columns == 1 ? "" : fmt::format(" with {} columns", columns)));
  }
  return entry.elements;
}

}  // namespace vorpipe
