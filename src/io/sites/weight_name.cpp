#include "io/sites/weight_name.h"

#include <algorithm>
#include <cmath>

#include "io/base/lower_case.h"
#include "io/base/quoted.h"

namespace vorpipe {

std::optional<WeightKind> weightNamed(std::string_view name, bool letters) {
  const std::string lower = lowerCase(name);
  if (lower == "weight" || (letters && lower == "w")) return WeightKind::weight;
  if (lower == "radius" || (letters && lower == "r")) return WeightKind::radius;
  return std::nullopt;
}

tl::expected<double, std::string> weightOf(WeightKind kind, double number, std::string_view text) {
  if (kind == WeightKind::weight) return number;
  if (number < 0) return tl::unexpected(inQuotes(text) + " is negative, and a radius");
  if (std::isfinite(number * number)) return number * number;
  return tl::unexpected("the square of " + inQuotes(text) + " is out of the range of a double");
}

}  // namespace vorpipe
