/// Arrays in memory as an .npz archive.
#pragma once

#include <cstdint>
#include <ranges>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/base/npy_array.h"
#include "io/base/zip_file.h"

namespace vorpipe {

/// The arrays of an archive, in the order in which they are added; their rows must outlive it.
class NpzArrays {
 public:
  /// Each of `rows` has `columns` numbers.
  template <class Number, std::uint64_t columns = 1, class Rows>
  void add(const char* name, const Rows& rows) {
    using Row = std::ranges::range_value_t<Rows>;
    NpyArray array = npyArray<Number, columns>(std::span<const Row>(rows));
    add(name, std::move(array.header), zipBody(array.elements));
  }
  template <class Number, std::uint64_t columns = 1, class Rows>
  void addUnlessEmpty(const char* name, const Rows& rows) {
    if (!std::ranges::empty(rows)) add<Number, columns>(name, rows);
  }
  void add(const char* name, std::string header, ZipBody elements) {
    entries_.push_back({std::string(name) + ".npy", std::move(header), std::move(elements)});
  }

  /// Errors: those of writeZip.
  Result<void> write(ByteSink& sink) const { return writeZip(sink, entries_); }

 private:
  std::vector<ZipEntry> entries_;
};

}  // namespace vorpipe
