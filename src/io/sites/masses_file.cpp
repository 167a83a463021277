#include "io/sites/masses_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/base/error.h"
#include "io/base/lower_case.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/site_numbers.h"
#include "io/sites/weight_name.h"

namespace vorpipe {
namespace {

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
  const auto has_name = [&](const Attribute& attribute) { return attribute.name() == name; };
  const auto found = std::ranges::find_if(attributes, has_name);
  if (found == attributes.end()) {
    std::vector<std::string> known;
    for (const Attribute& attribute : attributes) known.push_back(attribute.name());
    return inputError(fmt::format(
        "there is no attribute {}; {}", inQuotes(name),
        known.empty() ? "the sites have none" : fmt::format("known are {}", fmt::join(known, ", "))));
  }
  if (std::ranges::count_if(attributes, has_name) > 1) {
    return inputError(fmt::format("there are several attributes {}", inQuotes(name)));
  }
  std::vector<double> masses;
  masses.reserve(found->size());
  for (std::size_t site = 0; site < found->size(); ++site) {
    const auto wrong = [&](std::string_view what) {
      return inputError(fmt::format("{}: site {} (counted from 0): {}", inQuotes(name), site, what));
    };
    const auto text = found->at(site);
    if (!text) return wrong("there is no value");
    const auto number = parseNumber(*text);
    if (!number) return wrong(number.error());
    const auto mass = massOf(*number, trimmed(*text), zero);
    if (!mass) return wrong(mass.error());
    masses.push_back(*mass);
  }
  return masses;
}

}  // namespace vorpipe
