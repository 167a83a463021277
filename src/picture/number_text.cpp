#include "picture/number_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace vorpipe::core {
namespace {

constexpr int fewest_digits = 3, most_digits = 17;
/// Numbers from 10^least_exponent to 10^most_exponent are written without an exponent.
constexpr int least_exponent = -3, most_exponent = 6;

void dropLastZeros(std::string& digits) {
  if (digits.find('.') == std::string::npos) return;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
}

bool areDistinct(std::span<const double> numbers, std::span<const std::string> texts) {
  for (std::size_t i = 1; i < texts.size(); ++i) {
    if (numbers[i] != numbers[i - 1] && texts[i] == texts[i - 1]) return false;
  }
  return true;
}

}  // namespace

std::string numberText(double number, int digits) {
  if (number == 0) return "0";
  // Rounded first: 999.9 has the exponent of 1000.
  std::string scientific = fmt::format("{:.{}e}", number, digits - 1);
  const auto e = scientific.find('e');
  const int exponent = std::atoi(scientific.c_str() + e + 1);
  if (exponent >= least_exponent && exponent < most_exponent) {
    std::string fixed = fmt::format("{:.{}f}", number, std::max(0, digits - 1 - exponent));
    dropLastZeros(fixed);
    return fixed;
  }
  scientific.erase(e);
  dropLastZeros(scientific);
  return fmt::format("{}e{}", scientific, exponent);
}

std::vector<std::string> numberTexts(std::span<const double> numbers, std::size_t longest) {
  std::vector<std::string> texts(numbers.size());
  for (int digits = fewest_digits; digits <= most_digits; ++digits) {
    std::vector<std::string> tried(numbers.size());
    std::ranges::transform(numbers, tried.begin(), [&](double number) { return numberText(number, digits); });
    const bool fits = std::ranges::all_of(tried, [&](const auto& text) { return text.size() <= longest; });
    if (!fits && digits > fewest_digits) break;
    texts = std::move(tried);
    if (areDistinct(numbers, texts)) break;
  }
  return texts;
}

}  // namespace vorpipe::core
