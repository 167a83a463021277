#include "io/base/npy_array.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

constexpr std::size_t longest_header = std::size_t{1} << 20;
/// NumPy's limit.
constexpr std::size_t most_axes = 32;

/// Reads Python literals from the front of a text; every function returns false if the text differs.
class Literals {
 public:
  explicit Literals(std::string_view text) : text_(text) {}

  bool word(std::string_view expected) {
    skipBlanks();
    if (!text_.starts_with(expected)) return false;
    text_.remove_prefix(expected.size());
    return true;
  }
  bool string(std::string_view& value) {
    skipBlanks();
    const char mark = text_.empty() ? '\0' : text_.front();
    const std::size_t end = mark == '\'' || mark == '"' ? text_.find(mark, 1) : std::string_view::npos;
    if (end == std::string_view::npos) return false;
    value = text_.substr(1, end - 1);
    text_.remove_prefix(end + 1);
    return true;
  }
  bool boolean(bool& value) {
    value = word("True");
    return value || word("False");
  }
  bool integer(std::uint64_t& value) {
    skipBlanks();
    const auto [stop, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc()) return false;
    text_.remove_prefix(static_cast<std::size_t>(stop - text_.data()));
    word("L");  // suffix of long integers in Python 2
    return true;
  }
  bool tuple(std::vector<std::uint64_t>& values) {
    if (!word("(")) return false;
    while (!word(")")) {
      if (!integer(values.emplace_back())) return false;
      if (!word(",")) return word(")");
    }
    return true;
  }
  bool atEnd() {
    skipBlanks();
    return text_.empty();
  }

 private:
  void skipBlanks() { text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n"), text_.size())); }
  std::string_view text_;
};

/// Parses a dtype such as "<f8": kind, size and byte order. False for objects and the like.
bool parseType(std::string_view type, NpyHeader& header) {
  constexpr auto none = std::string_view::npos;
  if (type.size() < 3 || std::string_view("<>|=").find(type[0]) == none ||
      std::string_view("biufcU").find(type[1]) == none) {
    return false;
  }
  header.big_endian = type[0] == '>';
  header.kind = type[1];
  const auto [stop, error] = std::from_chars(type.data() + 2, type.data() + type.size(), header.size);
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  if (stop != type.data() + type.size() || error != std::errc() || header.size > most_bytes) return false;
  if (header.kind == 'U') header.size *= sizeof(char32_t);
  return header.size > 0 || header.kind == 'U';
}

bool parseDictionary(std::string_view text, NpyHeader& header, std::string_view& type) {
  Literals literals(text);
  bool has_type = false, has_order = false, has_shape = false;
  if (!literals.word("{")) return false;
  while (!literals.word("}")) {
    std::string_view key;
    if (!literals.string(key) || !literals.word(":")) return false;
    bool* const seen = key == "descr"           ? &has_type
                       : key == "fortran_order" ? &has_order
                       : key == "shape"         ? &has_shape
                                                : nullptr;
    if (seen == nullptr || std::exchange(*seen, true)) return false;
    const bool valid = seen == &has_type    ? literals.string(type)
                       : seen == &has_order ? literals.boolean(header.fortran_order)
                                            : literals.tuple(header.shape);
    if (!valid) return false;
    if (!literals.word(",")) {
      if (!literals.word("}")) return false;
      break;
    }
  }
  return literals.atEnd() && has_type && has_order && has_shape;
}

std::string typeName(const NpyHeader& header, std::string_view type) {
  const std::string_view kind = header.kind == 'f'   ? "float"
                                : header.kind == 'i' ? "int"
                                : header.kind == 'u' ? "uint"
                                : header.kind == 'b' ? "bool"
                                                     : "";
  if (kind.empty()) return std::string(type);
  return header.kind == 'b' ? std::string(kind) : fmt::format("{}{}", kind, 8 * header.size);
}

/// Bytes of all elements; none if 63 bits cannot hold it.
std::optional<std::uint64_t> dataBytesOf(const NpyHeader& header) {
  std::uint64_t bytes = header.size;
  for (const std::uint64_t extent : header.shape) {
    if (extent != 0 && bytes > std::numeric_limits<std::uint64_t>::max() / extent) return std::nullopt;
    bytes *= extent;
  }
  if (bytes > std::numeric_limits<std::int64_t>::max()) return std::nullopt;
  return bytes;
}

/// Reads `length` bytes of a header, of which `offset` bytes were read.
Result<std::string> readPart(InputFile& file, std::size_t length, std::size_t offset) {
  std::string text(length, '\0');
  VORPIPE_LET(got, file.read(text));
  if (got < length) {
    return inputError(fmt::format("{}: is truncated: it holds {} bytes, its .npy header needs {}",
                                  file.name(), offset + got, offset + length));
  }
  return text;
}

/// Returns the dictionary as text, and the number of bytes before the data.
Result<std::pair<std::string, std::size_t>> readDictionary(InputFile& file) {
  constexpr std::size_t preamble_size = 10;
  VORPIPE_VAR(preamble, readPart(file, preamble_size, 0));
  if (!preamble.starts_with(npy_magic)) {
    return inputError(file.name() + ": is not a .npy file: it does not begin with \\x93NUMPY");
  }
  const auto version = static_cast<unsigned char>(preamble[6]);
  if (version < 1 || version > 3) {
    return inputError(fmt::format("{}: version {} of .npy is not known; 1 to 3 are", file.name(), version));
  }
  std::size_t offset = preamble_size;
  if (version > 1) {
    VORPIPE_LET(rest, readPart(file, 2, offset));
    preamble += rest;
    offset += 2;
  }
  std::size_t length = 0;
  for (std::size_t i = offset; i-- > 8;) {
    length = length << 8 | static_cast<unsigned char>(preamble[i]);
  }
  if (length > longest_header) {
    return inputError(fmt::format("{}: is damaged: its .npy header claims {} bytes", file.name(), length));
  }
  VORPIPE_VAR(text, readPart(file, length, offset));
  return std::pair(std::move(text), offset + length);
}

}  // namespace

Result<NpyHeader> parseNpyHeader(std::string_view text, const std::string& name) {
  NpyHeader header;
  std::string_view type;
  if (!parseDictionary(text, header, type)) {
    return inputError(fmt::format("{}: its .npy header is not understood: {}", name, inQuotes(text)));
  }
  if (header.shape.size() > most_axes) {
    return inputError(fmt::format("{}: its .npy header claims {} axes; {} are the most", name,
                                  header.shape.size(), most_axes));
  }
  if (!parseType(type, header)) {
    return inputError(
        fmt::format("{}: holds elements of dtype {}; numbers are needed", name, inQuotes(type)));
  }
  header.description = fmt::format("{} ({}{})", typeName(header, type), fmt::join(header.shape, ", "),
                                   header.shape.size() == 1 ? "," : "");
  const auto data_bytes = dataBytesOf(header);
  if (!data_bytes) {
    return inputError(
        fmt::format("{}: its .npy header claims an impossible size: {}", name, header.description));
  }
  header.data_bytes = *data_bytes;
  return header;
}

Result<NpyHeader> readNpyHeader(InputFile& file) {
  VORPIPE_LET(dictionary, readDictionary(file));
  const auto& [text, begin] = dictionary;
  auto header = parseNpyHeader(text, file.name());
  if (!header) return header;
  if (header->kind == 'U') {
    return inputError(fmt::format("{}: holds {}; numbers are needed", file.name(), header->description));
  }
  const std::uint64_t bytes = header->data_bytes;
  if (file.size() && *file.size() != begin + bytes) {
    return inputError(fmt::format("{}: {}: it holds {} bytes, its header ({}) needs {}", file.name(),
                                  *file.size() < begin + bytes ? "is truncated" : "is too long", *file.size(),
                                  header->description, begin + bytes));
  }
  if (file.mostBytes() && *file.mostBytes() < bytes) {
    return inputError(
        fmt::format("{}: is damaged: what is packed in it cannot hold {}", file.name(), header->description));
  }
  return header;
}

std::string npyHeader(std::string_view type, std::span<const std::uint64_t> shape) {
  constexpr std::size_t preamble_size = 10, alignment = 64;
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                                 fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  while ((preamble_size + text.size() + 1) % alignment != 0) text += ' ';
  text += '\n';
  std::string header(npy_magic);
  header += {'\x01', '\x00', static_cast<char>(text.size() & 0xFF), static_cast<char>(text.size() >> 8)};
  return header + text;
}

}  // namespace vorpipe
