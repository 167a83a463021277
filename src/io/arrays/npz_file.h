/// Archives of NumPy's arrays that are read at once: .npz files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/arrays/npy_array.h"
#include "vorpipe.h"

namespace vorpipe {

/// An array as its file has it.
struct NpzEntry {
  std::string type;  ///< NumPy's dtype, as "<f8"
  std::vector<std::uint64_t> shape;
  std::string_view elements;  ///< in C order
};

/// Arrays by name, stored without compression as numpy.savez and writeZip() do.
class NpzFile {
 public:
  /// Errors (input): it cannot be read; it is no such archive; an array in it is not understood. They begin
  /// with its path.
  static Result<NpzFile> read(const std::string& path);

  [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }
  /// The numbers of an array with `columns` of them in a row; empty where there is no such array. Error
  /// (input): they are of another type, or their shape is another.
  template <class Number>
  [[nodiscard]] Result<std::vector<Number>> numbers(const std::string& name,
                                                    std::uint64_t columns = 1) const {
    std::vector<Number> values;
    const auto bytes = elements(name, npyType<Number>(), columns);
    if (!bytes) return tl::unexpected(bytes.error());
    values.resize(bytes->size() / sizeof(Number));
    bytes->copy(reinterpret_cast<char*>(values.data()), values.size() * sizeof(Number));
    return values;
  }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  NpzFile(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}
  Result<void> index();
  Result<void> add(std::string_view name, std::string_view array);
  [[nodiscard]] Result<std::string_view> elements(const std::string& name, const std::string& type,
                                                  std::uint64_t columns) const;

  std::string name_, bytes_;
  std::map<std::string, NpzEntry> entries_;
};

}  // namespace vorpipe
