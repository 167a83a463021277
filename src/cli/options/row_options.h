/// Declares options by their rows.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/option_rows.h"
#include "base/try.h"
#include "cli/options/options.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {

/// Parses one of the names from that of `first` on.
template <Named Enum>
Parsed<Enum> parseNameOf(std::string_view text, Enum first = Enum{}) {
  if (const auto value = valueNamed<Enum>(text, first)) return *value;
  return tl::unexpected(fmt::format("{} is not {}", inQuotes(text), anyOf(namesFrom(first))));
}

template <class Struct, class Enum>
Parsed<Enum> parseOf(const ChoiceRow<Struct, Enum>& /*row*/, std::string_view text) {
  return parseNameOf<Enum>(text);
}

/// Parses a number in the range of its row.
template <class Struct, class Number>
Parsed<Number> parseOf(const NumberRow<Struct, Number>& row, std::string_view text) {
  if (row.zero != nullptr && text == row.zero) return Number{0};
  if constexpr (std::is_integral_v<Number>) {
    return parseWhole(text, static_cast<std::uint64_t>(row.least_given), static_cast<std::uint64_t>(row.most))
        .map([](auto number) { return static_cast<Number>(number); });
  } else {
    VORPIPE_LET(number, parseNumber(text));
    if (number >= row.least_given && number <= row.most) return number;
    if (row.range != nullptr) return tl::unexpected(fmt::format("{} is not {}", number, row.range));
    return tl::unexpected(
        fmt::format("{} is not a number of{} from {} to {}", number, row.unit, row.least_given, row.most));
  }
}

template <class Struct>
Parsed<Color> parseOf(const ColorRow<Struct>& row, std::string_view text) {
  if (row.opaque) return parseOpaqueColor(text);
  return readColor(text).map_error([](Error error) { return std::move(error.message); });
}

template <class Struct>
Parsed<Point> parseOf(const PointRow<Struct>& row, std::string_view text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const auto x = parseNumber(text.substr(0, comma));
  if (const auto y = parseNumber(text.substr(std::min(comma + 1, text.size()))); x && y) return Point{*x, *y};
  return tl::unexpected(fmt::format("{} is not {}", inQuotes(text), row.value));
}

/// Adds the option of a row; its value goes to `target`, and its name, unless it is a flag, to `given`.
/// `usual` describes the default where that is not the value in `target`.
template <class Row, class Struct>
Option addRow(Options& options, const Row& row, Struct& target, std::set<std::string_view>& given,
              std::string_view usual = {}) {
  auto& member = target.*row.member;
  if constexpr (std::is_same_v<Row, FlagRow<Struct>>) {
    return options.addFlag(flagOf(row), member, row.help);
  } else {
    std::string help = row.help;
    Choices choices;
    if constexpr (requires { row.most; }) {
      std::string text = usual.empty() ? fmt::format("{}", member) : std::string(usual);
      if (const auto zero = text.find("e-0"); zero != std::string::npos) text.erase(zero + 2, 1);
      help = fmt::format(fmt::runtime(help), row.least_given, row.most, text);
    } else if constexpr (requires { nameOf(member); }) {
      help = fmt::format(fmt::runtime(help), nameOf(member));
      choices.words = namesFrom(std::decay_t<decltype(member)>{});
    }
    const auto take = [&member, &given, name = row.name](const auto& value) {
      member = value;
      given.insert(name);
    };
    const auto parse = [row](std::string_view text) { return parseOf(row, text); };
    return options.add(flagOf(row), parsedValue(row.value, parse, take, std::move(choices)), help);
  }
}

}  // namespace vorpipe::cli
