#include "io/sites/site_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <utility>

#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/line_reader.h"
#include "io/base/npy_elements.h"
#include "io/base/npy_header.h"
#include "io/base/number.h"

namespace vorpipe {
namespace {

std::string sitesText(std::uint64_t count) { return fmt::format("{} site{}", count, count == 1 ? "" : "s"); }

/// Returns the value of a line; `text` is the line without comment and blanks.
Result<double> valueIn(const LineReader& lines, std::string_view line, std::string_view text,
                       const NumbersKind& kind) {
  const auto column = static_cast<std::size_t>(text.data() - line.data()) + 1;
  const auto number = parseNumber(text);
  if (!number) return lines.errorAt(column, number.error());
  const auto value = kind.value(*number, text);
  if (!value) return lines.errorAt(column, value.error());
  return *value;
}

Result<std::vector<double>> readLines(InputFile file, std::uint64_t count, const NumbersKind& kind) {
  LineReader lines(std::move(file));
  std::vector<double> values;
  bool first = true;
  while (true) {
    const auto line = lines.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line && values.size() < count) {
      return lines.errorAt(1, fmt::format("the file ends after {} {}, there are {}", values.size(), kind.many,
                                          sitesText(count)));
    }
    if (!*line) return values;
    const std::string_view text = trimmed((*line)->substr(0, (*line)->find('#')));
    if (text.empty()) continue;
    if (std::exchange(first, false) && kind.header(text)) continue;
    if (values.size() == count) {
      return lines.errorAt(1, fmt::format("a {} too many, there are {}", kind.one, sitesText(count)));
    }
    const auto value = valueIn(lines, **line, text, kind);
    if (!value) return tl::unexpected(value.error());
    values.push_back(*value);
  }
}

Result<std::vector<double>> readElements(InputFile& file, const NpyHeader& header, std::uint64_t count,
                                         const NumbersKind& kind) {
  std::vector<double> values(count);
  const auto read = eachNumber(file, header, count, [&](std::uint64_t index, auto element) -> Result<void> {
    const auto number = static_cast<double>(element);
    if (!std::isfinite(number)) {
      return inputError(fmt::format("{}: element [{}] (counted from 0) is {}, not a finite number",
                                    file.name(), index, number));
    }
    const auto value = kind.value(number, fmt::to_string(element));
    if (!value) {
      return inputError(
          fmt::format("{}: element [{}] (counted from 0): {}", file.name(), index, value.error()));
    }
    values[index] = *value;
    return {};
  });
  return read.map([&] { return std::move(values); });
}

Result<std::vector<double>> readNpy(InputFile file, std::uint64_t count, const NumbersKind& kind) {
  const auto header = readNpyHeader(file);
  if (!header) return tl::unexpected(header.error());
  const auto& shape = header->shape;
  const bool one_column = shape.size() == 1 || (shape.size() == 2 && shape[1] == 1);
  if (!areNumbers(*header) || !one_column) {
    return inputError(fmt::format("{}: holds {}; numbers (N,), float32, float64 or whole ones, are needed",
                                  file.name(), header->description));
  }
  if (shape[0] != count) {
    return inputError(
        fmt::format("{}: holds {} {}, there are {}", file.name(), shape[0], kind.many, sitesText(count)));
  }
  return readElements(file, *header, count, kind);
}

}  // namespace

Result<std::vector<double>> readSiteNumbers(const std::string& path, std::uint64_t count,
                                            const NumbersKind& kind) {
  const std::string extension = inputExtension(path);
  const bool text = extension == ".txt" || extension == ".csv";
  if (!text && extension != ".npy") {
    return inputError(
        fmt::format("{}: unknown kind of file for {}; known are .txt, .csv and .npy", path, kind.many));
  }
  auto file = InputFile::open(path);
  if (!file) return tl::unexpected(file.error());
  try {
    return text ? readLines(std::move(*file), count, kind) : readNpy(std::move(*file), count, kind);
  } catch (const std::bad_alloc&) {
    return deviceError(fmt::format("{}: there is not enough memory for its {}", path, kind.many));
  }
}

}  // namespace vorpipe
