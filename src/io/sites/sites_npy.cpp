#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/arrays/npy_elements.h"
#include "io/arrays/npy_header.h"
#include "io/files/error.h"
#include "io/sites/sites_file.h"
#include "io/sites/sites_reader.h"

namespace vorpipe {
namespace {

template <class Real>
Result<void> readElements(InputFile& file, const NpyHeader& header, Sites& sites) {
  constexpr std::array<std::string_view, 3> names = {"x", "y", "weight"};
  const std::array<std::vector<double>*, 3> into = {&sites.x, &sites.y, &sites.weight};
  const std::uint64_t rows = header.shape[0];
  const std::uint64_t columns = header.shape[1];
  // Row and column by counting: a division for each element costs more than reading it.
  std::uint64_t row = 0, column = 0;
  return eachElement<Real>(file, header, rows * columns, [&](std::uint64_t, Real value) -> Result<void> {
    if (!std::isfinite(value)) {
      return inputError(
          fmt::format("{}: element [{}, {}] (counted from 0; column {}) is {}, not a finite number",
                      file.name(), row, column, names[column], value));
    }
    into[column]->push_back(static_cast<double>(value));
    std::uint64_t& inner = header.fortran_order ? row : column;
    std::uint64_t& outer = header.fortran_order ? column : row;
    if (++inner == (header.fortran_order ? rows : columns)) {
      inner = 0;
      ++outer;
    }
    return {};
  });
}

}  // namespace

Result<Sites> readNpySites(InputFile file) {
  const auto header = readNpyHeader(file);
  if (!header) {
    return tl::unexpected(header.error());
  }
  const bool real = header->kind == 'f' && (header->size == sizeof(float) || header->size == sizeof(double));
  const auto& shape = header->shape;
  if (!real || shape.size() != 2 || (shape[1] != 2 && shape[1] != 3)) {
    return inputError(fmt::format("{}: holds {}; float32 or float64 (N, 2) or (N, 3) is needed", file.name(),
                                  header->description));
  }
  if (shape[0] > max_sites) {
    return inputError(fmt::format("{}: holds more than {} sites", file.name(), max_sites));
  }
  Sites sites;
  const Result<void> read = header->size == sizeof(float) ? readElements<float>(file, *header, sites)
                                                          : readElements<double>(file, *header, sites);
  if (!read) {
    return tl::unexpected(read.error());
  }
  return sites;
}

}  // namespace vorpipe
