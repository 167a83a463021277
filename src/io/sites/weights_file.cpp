#include "io/sites/weights_file.h"

#include <optional>
#include <random>
#include <string_view>

#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/npy_array.h"
#include "io/base/print.h"
#include "io/sites/site_numbers.h"
#include "io/sites/weight_name.h"

namespace vorpipe {

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
  const std::string extension = lowerExtension(path);
  if (extension == ".txt" || extension == ".csv" || extension == ".npy") return {};
  return inputError(path + ": unknown kind of file for weights; known are .txt, .csv and .npy");
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

}  // namespace vorpipe
