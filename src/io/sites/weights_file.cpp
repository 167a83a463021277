#include "io/sites/weights_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <optional>
#include <random>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/input_file.h"
#include "io/base/line_reader.h"
#include "io/base/npy_array.h"
#include "io/base/number.h"
#include "io/base/print.h"
#include "io/base/quoted.h"
#include "io/sites/attribute_values.h"
#include "io/sites/site_columns.h"

namespace vorpipe {
namespace {

/// Meaning of a file's numbers.
struct NumbersKind {
  std::string_view one, many;  ///< "weight", "weights", for messages
  /// Whether the first line of a text is a header that names the numbers, not a number.
  std::function<bool(std::string_view line)> header;
  /// Converts a finite number to its value. The error states what is wrong with it; `text` is the number as
  /// written.
  std::function<tl::expected<double, std::string>(double number, std::string_view text)> value;
};

bool isNumbersFile(const std::string& extension) {
  return extension == ".txt" || extension == ".csv" || extension == ".npy";
}

tl::unexpected<Error> unknownKind(const std::string& path, std::string_view numbers) {
  return inputError(
      fmt::format("{}: unknown kind of file for {}; known are .txt, .csv and .npy", path, numbers));
}

std::string sitesText(std::uint64_t count) { return fmt::format("{} site{}", count, count == 1 ? "" : "s"); }

Result<std::vector<double>> readLines(InputFile file, std::uint64_t count, const NumbersKind& kind) {
  LineReader lines(std::move(file));
  std::vector<double> values;
  bool first = true;
  while (true) {
    VORPIPE_LET(line, lines.next());
    if (!line && values.size() < count) {
      return lines.errorAt(1, fmt::format("the file ends after {} {}, there are {}", values.size(), kind.many,
                                          sitesText(count)));
    }
    if (!line) return values;
    const std::string_view text = trimmed(line->substr(0, line->find('#')));
    if (text.empty()) continue;
    if (std::exchange(first, false) && kind.header(text)) continue;
    if (values.size() == count) {
      return lines.errorAt(1, fmt::format("a {} too many, there are {}", kind.one, sitesText(count)));
    }
    const auto value = parseNumber(text).and_then([&](double number) { return kind.value(number, text); });
    if (!value) {
      return lines.errorAt(static_cast<std::size_t>(text.data() - line->data()) + 1, value.error());
    }
    values.push_back(*value);
  }
}

Result<std::vector<double>> readNumpy(InputFile file, std::uint64_t count, const NumbersKind& kind) {
  VORPIPE_LET(header, readNpyHeader(file));
  const auto& shape = header.shape;
  const bool one_column = shape.size() == 1 || (shape.size() == 2 && shape[1] == 1);
  if (!areNumbers(header) || !one_column) {
    return inputError(fmt::format("{}: holds {}; numbers (N,), float32, float64 or whole ones, are needed",
                                  file.name(), header.description));
  }
  if (shape[0] != count) {
    return inputError(
        fmt::format("{}: holds {} {}, there are {}", file.name(), shape[0], kind.many, sitesText(count)));
  }
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

Result<std::vector<double>> readSiteNumbers(const std::string& path, std::uint64_t count,
                                            const NumbersKind& kind) {
  const std::string extension = inputExtension(path);
  if (!isNumbersFile(extension)) return unknownKind(path, kind.many);
  VORPIPE_VAR(file, InputFile::open(path));
  try {
    return extension == ".npy" ? readNumpy(std::move(file), count, kind)
                               : readLines(std::move(file), count, kind);
  } catch (const std::bad_alloc&) {
    return deviceError(fmt::format("{}: there is not enough memory for its {}", path, kind.many));
  }
}

tl::expected<double, std::string> massOf(double number, std::string_view text, ZeroMass zero) {
  if (number > 0 || (number == 0 && zero == ZeroMass::taken)) return number;
  return tl::unexpected(inQuotes(text) +
                        (number < 0 ? " is negative, and a mass" : " is no mass: it must be more than 0"));
}

bool isName(std::string_view line) {
  const std::string lower = lowerCase(line);
  // These were meant as numbers, and errors report them as such.
  if (lower == "nan" || lower == "inf" || lower == "infinity") return false;
  return (lower[0] >= 'a' && lower[0] <= 'z') || lower[0] == '_' || lower[0] == '"';
}

}  // namespace

Result<std::vector<double>> readWeights(const std::string& path, std::uint64_t count) {
  WeightKind kind = WeightKind::weight;
  const auto header = [&kind](std::string_view line) {
    const auto named = weightNamed(line, false);
    kind = named.value_or(kind);
    return named.has_value();
  };
  const auto value = [&kind](double number, std::string_view text) { return weightOf(kind, number, text); };
  return readSiteNumbers(path, count, {"weight", "weights", header, value});
}

Result<void> checkWeightsPath(const std::string& path) {
  return isNumbersFile(lowerExtension(path)) ? Result<void>() : unknownKind(path, "weights");
}

Result<void> writeWeights(ByteSink& sink, const std::vector<double>& weights, const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension == ".npy") {
    const auto array = npyArray<double, 1>(std::span(weights));
    return sink.write(array.header).and_then([&] { return sink.write(array.elements); });
  }
  const std::string_view header = extension == ".csv" ? "weight\n" : "";
  return sink.write(header).and_then([&] {
    return writeEach(sink, weights.size(),
                     [&](Bytes& text, std::size_t site) { print(text, FMT_COMPILE("{}\n"), weights[site]); });
  });
}

std::vector<double> randomWeights(double low, double high, std::uint64_t count, std::uint64_t seed) {
  // Not the generator's stream, from which weights would repeat the coordinates.
  constexpr std::uint64_t own_stream = 0x9E3779B97F4A7C15u;
  std::mt19937_64 random(seed ^ own_stream);
  std::vector<double> weights(count);
  for (double& weight : weights) {
    const double part = static_cast<double>(random() >> 11) * 0x1p-53;
    weight = low + part * (high - low);
  }
  return weights;
}

tl::expected<void, std::string> checkMass(std::string_view text, ZeroMass zero) {
  // Whether a comma is a decimal comma shows only when all are read.
  return parseDecimal(text)
      .and_then([&](const Decimal& number) { return massOf(number.value, trimmed(text), zero); })
      .map([](double) {});
}

Result<std::vector<double>> readMasses(const std::string& path, std::uint64_t count, ZeroMass zero) {
  const auto value = [zero](double number, std::string_view text) { return massOf(number, text, zero); };
  return readSiteNumbers(path, count, {"mass", "masses", isName, value});
}

Result<std::vector<double>> massesIn(std::span<const Attribute> attributes, std::string_view name,
                                     ZeroMass zero) {
  VORPIPE_LET(found, attributeNamed(attributes, name));
  std::vector<double> masses;
  masses.reserve(found->size());
  for (std::size_t site = 0; site < found->size(); ++site) {
    const auto wrong = [&](std::string_view what) {
      return inputError(fmt::format("{}: site {} (counted from 0): {}", inQuotes(name), site, what));
    };
    const auto text = found->at(site);
    if (!text) return wrong("there is no value");
    const auto mass =
        parseNumber(*text).and_then([&](double number) { return massOf(number, trimmed(*text), zero); });
    if (!mass) return wrong(mass.error());
    masses.push_back(*mass);
  }
  return masses;
}

}  // namespace vorpipe
