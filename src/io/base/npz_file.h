/// Archives of NumPy's arrays that are read at once: .npz files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/base/npy_array.h"
#include "io/base/npy_elements.h"
#include "io/base/npy_header.h"
#include "vorpipe.h"

namespace vorpipe {

/// An array as its file has it.
struct NpzEntry {
  NpyHeader header;
  std::string_view elements;
};

/// Whether a Number is this very number; no integer is a floating-point one's.
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
  /// Errors (input): it cannot be read; it is no such archive; an array in it is not understood. They begin
  /// with its path.
  static Result<NpzFile> read(const std::string& path);

  [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }
  [[nodiscard]] std::vector<std::string> names() const;
  /// The numbers of an array with `columns` of them in a row, whatever their type and order in the file are;
  /// empty where there is no such array. Error (input): they are no numbers, or one is not a Number, as 1.5
  /// is no integer; their shape is another.
  template <class Number>
  [[nodiscard]] Result<std::vector<Number>> numbers(const std::string& name,
                                                    std::uint64_t columns = 1) const {
    std::vector<Number> values;
    const auto entry = entryOf(name, columns);
    if (!entry) return tl::unexpected(entry.error());
    if (*entry == nullptr) return values;
    const auto read = withType((*entry)->header, [&]<class Value>(Value) -> Result<void> {
      return copy<Value>(name, **entry, columns, values);
    });
    if (!read) return tl::unexpected(read.error());
    return values;
  }
  /// The only text of an array that holds one; none where it is another array, or none.
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
  /// The archive, and arrays that were packed in it: what elements look at.
  std::deque<std::string> bytes_{};
  std::map<std::string, NpzEntry> entries_{};
};

}  // namespace vorpipe
