/// What columns and properties of weights are called, and what they hold.
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

/// What messages say that it is.
constexpr std::string_view meaningOf(WeightKind kind) {
  return kind == WeightKind::weight ? "weight" : "radius, whose square is the weight";
}

/// What weight or radius, in any case, stands for; w and r as well where `letters` has it so.
std::optional<WeightKind> weightNamed(std::string_view name, bool letters);

/// The weight that a number is. The error is what is wrong with it, which `text` says: a radius is negative,
/// or its square is no double.
tl::expected<double, std::string> weightOf(WeightKind kind, double number, std::string_view text);

}  // namespace vorpipe
