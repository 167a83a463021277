#include "io/sites/weights_file.h"

#include <fmt/core.h>

#include <cmath>
#include <new>
#include <optional>
#include <random>
#include <string_view>
#include <utility>

#include "io/arrays/npy_elements.h"
#include "io/arrays/npy_header.h"
#include "io/files/error.h"
#include "io/files/extension.h"
#include "io/files/input_file.h"
#include "io/sites/weight_name.h"
#include "io/text/line_reader.h"
#include "io/text/number.h"

namespace vorpipe {
namespace {

std::string sitesText(std::uint64_t count) { return fmt::format("{} site{}", count, count == 1 ? "" : "s"); }

/// The weight that a line holds, of which comment and blanks are taken off.
Result<double> weightIn(const LineReader& lines, std::string_view line, std::string_view text,
                        WeightKind kind) {
  const auto column = static_cast<std::size_t>(text.data() - line.data()) + 1;
  const auto number = parseNumber(text);
  if (!number) return lines.errorAt(column, number.error());
  const auto weight = weightOf(kind, *number, text);
  if (!weight) return lines.errorAt(column, weight.error());
  return *weight;
}

Result<std::vector<double>> readWeightLines(InputFile file, std::uint64_t count) {
  LineReader lines(std::move(file));
  std::vector<double> weights;
  bool first = true;
  WeightKind kind = WeightKind::weight;
  while (true) {
    const auto line = lines.next();
    if (!line) {
      return tl::unexpected(line.error());
    }
    if (!*line && weights.size() < count) {
      return lines.errorAt(
          1, fmt::format("the file ends after {} weights, there are {}", weights.size(), sitesText(count)));
    }
    if (!*line) {
      return weights;
    }
    const std::string_view text = trimmed((*line)->substr(0, (*line)->find('#')));
    if (text.empty()) {
      continue;
    }
    const auto named = std::exchange(first, false) ? weightNamed(text, false) : std::nullopt;
    if (named) {
      kind = *named;
      continue;
    }
    if (weights.size() == count) {
      return lines.errorAt(1, "a weight too many, there are " + sitesText(count));
    }
    const auto weight = weightIn(lines, **line, text, kind);
    if (!weight) {
      return tl::unexpected(weight.error());
    }
    weights.push_back(*weight);
  }
}

template <class Real>
Result<std::vector<double>> readElements(InputFile& file, const NpyHeader& header, std::uint64_t count) {
  std::vector<double> weights(count);
  const auto read =
      eachElement<Real>(file, header, count, [&](std::uint64_t index, Real value) -> Result<void> {
        if (!std::isfinite(value)) {
          return inputError(fmt::format("{}: element [{}] (counted from 0) is {}, not a finite number",
                                        file.name(), index, value));
        }
        weights[index] = static_cast<double>(value);
        return {};
      });
  return read.map([&] { return std::move(weights); });
}

Result<std::vector<double>> readNpy(InputFile file, std::uint64_t count) {
  const auto header = readNpyHeader(file);
  if (!header) {
    return tl::unexpected(header.error());
  }
  const bool real = header->kind == 'f' && (header->size == sizeof(float) || header->size == sizeof(double));
  const auto& shape = header->shape;
  const bool one_column = shape.size() == 1 || (shape.size() == 2 && shape[1] == 1);
  if (!real || !one_column) {
    return inputError(
        fmt::format("{}: holds {}; float32 or float64 (N,) is needed", file.name(), header->description));
  }
  if (shape[0] != count) {
    return inputError(
        fmt::format("{}: holds {} weights, there are {}", file.name(), shape[0], sitesText(count)));
  }
  return header->size == sizeof(float) ? readElements<float>(file, *header, count)
                                       : readElements<double>(file, *header, count);
}

}  // namespace

Result<std::vector<double>> readWeights(const std::string& path, std::uint64_t count) {
  const std::string extension = inputExtension(path);
  const bool text = extension == ".txt" || extension == ".csv";
  if (!text && extension != ".npy") {
    return inputError(path + ": unknown kind of file for weights; known are .txt, .csv and .npy");
  }
  auto file = InputFile::open(path);
  if (!file) {
    return tl::unexpected(file.error());
  }
  try {
    return text ? readWeightLines(std::move(*file), count) : readNpy(std::move(*file), count);
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its weights");
  }
}

std::vector<double> randomWeights(double low, double high, std::uint64_t count, std::uint64_t seed) {
  // Not the generator's stream, of which weights would repeat the coordinates.
  constexpr std::uint64_t own_stream = 0x9E3779B97F4A7C15u;
  std::mt19937_64 random(seed ^ own_stream);
  std::vector<double> weights(count);
  for (double& weight : weights) {
    const double part = static_cast<double>(random() >> 11) * 0x1p-53;
    weight = low + part * (high - low);
  }
  return weights;
}

}  // namespace vorpipe
