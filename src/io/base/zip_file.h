/// Zip archives of files that are in memory, and NumPy's .npz archives of arrays, read all at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/byte_sink.h"
#include "io/base/npy_array.h"
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

/// An array as stored in its file.
struct NpzEntry {
  NpyHeader header;
  std::string_view elements;
};

/// Whether a Number holds this value exactly; no integer type holds a floating-point value.
template <class Number, class Value>
bool isHeldBy(Value value) {
  if constexpr (!std::is_integral_v<Number>) {
    return isExact(value);
  } else if constexpr (std::is_integral_v<Value>) {
    return std::in_range<Number>(value);
  } else {
    return false;
  }
}

/// Arrays by name, as numpy.savez, numpy.savez_compressed and writeZip() write them.
class NpzFile {
 public:
  /// Errors (input) begin with the path: it cannot be read, is no such archive, or has an array that is not
  /// understood.
  static Result<NpzFile> read(const std::string& path);

  [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }
  [[nodiscard]] std::vector<std::string> names() const;
  /// Returns the numbers of an array with `columns` columns, whatever their type and order in the file; empty
  /// if there is no such array. Error (input): they are no numbers, a Number cannot hold one, as an integer
  /// 1.5, or the shape differs.
  template <class Number>
  [[nodiscard]] Result<std::vector<Number>> numbers(const std::string& name,
                                                    std::uint64_t columns = 1) const {
    std::vector<Number> values;
    VORPIPE_LET(entry, entryOf(name, columns));
    if (entry == nullptr) return values;
    const auto read = withType(entry->header, [&]<class Value>(Value) -> Result<void> {
      return copy<Value>(name, *entry, columns, values);
    });
    if (!read) return tl::unexpected(read.error());
    return values;
  }
  /// Returns the only text of an array that holds one; none if it is another array or missing.
  [[nodiscard]] std::optional<std::string> text(const std::string& name) const;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  explicit NpzFile(std::string name) : name_(std::move(name)) {}
  Result<void> index(std::string_view archive);
  Result<void> add(std::string_view name, std::string_view array);
  [[nodiscard]] Result<const NpzEntry*> entryOf(const std::string& name, std::uint64_t columns) const;
  [[nodiscard]] Error notHeld(const std::string& name, std::uint64_t index, std::string_view type) const;

  template <class Value, class Number>
  Result<void> copy(const std::string& name, const NpzEntry& entry, std::uint64_t columns,
                    std::vector<Number>& values) const {
    const std::uint64_t count = entry.elements.size() / sizeof(Value), rows = count / columns;
    values.resize(count);
    for (std::uint64_t k = 0; k < count; ++k) {
      const auto value = valueOf<Value>(entry.elements.data() + k * sizeof(Value), entry.header.big_endian);
      if (!isHeldBy<Number>(value)) return tl::unexpected(notHeld(name, k, npyType<Number>()));
      values[entry.header.fortran_order ? k % rows * columns + k / rows : k] = static_cast<Number>(value);
    }
    return {};
  }

  std::string name_;
  /// The archive, and arrays inflated from it; elements point into these.
  std::deque<std::string> bytes_{};
  std::map<std::string, NpzEntry> entries_{};
};

}  // namespace vorpipe
