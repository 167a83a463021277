/// Names of columns and properties with weights, and their meaning.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

enum class WeightKind : std::uint8_t {
  weight,
  radius,  ///< its square is the weight
};

/// Name of a kind in messages.
constexpr std::string_view meaningOf(WeightKind kind) {
  return kind == WeightKind::weight ? "weight" : "radius, whose square is the weight";
}

/// Returns the kind that "weight" or "radius", in any case, names; also w and r if `letters` is set.
std::optional<WeightKind> weightNamed(std::string_view name, bool letters);

/// Returns the weight that a number stands for. The error states what is wrong with it, quoting `text`: a
/// radius is negative, or its square is no double.
tl::expected<double, std::string> weightOf(WeightKind kind, double number, std::string_view text);

}  // namespace vorpipe
