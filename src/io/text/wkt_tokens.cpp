#include "io/text/wkt_tokens.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <system_error>

#include "io/files/error.h"
#include "io/text/number.h"
#include "io/text/text_place.h"

namespace vorpipe {
namespace {

constexpr std::array<std::string_view, 3> dimensions = {"Z", "M", "ZM"};

bool sameWord(std::string_view text, std::string_view upper) {
  return std::ranges::equal(text, upper,
                            [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; });
}

}  // namespace

bool WktTokens::is(std::string_view word) const { return sameWord(token_, word); }

void WktTokens::next() {
  const auto isBlank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto isSign = [](char c) { return c == '(' || c == ')' || c == ',' || c == ';'; };
  place_ += token_.size();
  while (place_ < text_.size() && isBlank(text_[place_])) ++place_;
  std::size_t end = place_;
  while (end < text_.size() && !isBlank(text_[end]) && !isSign(text_[end])) ++end;
  if (end == place_ && end < text_.size()) ++end;
  token_ = text_.substr(place_, end - place_);
}

bool WktTokens::take(std::string_view word) {
  if (!is(word)) return false;
  next();
  return true;
}

bool WktTokens::takeType(std::string_view name) {
  if (!sameWord(token_.substr(0, name.size()), name)) return false;
  const std::string_view rest = token_.substr(name.size());
  const auto isDimension = [](std::string_view text) {
    return std::ranges::any_of(dimensions, [text](std::string_view word) { return sameWord(text, word); });
  };
  if (!rest.empty() && !isDimension(rest)) return false;
  next();
  if (rest.empty() && isDimension(token_)) next();
  return true;
}

WktProblem WktTokens::takeSystem(std::optional<std::int64_t>& code) {
  constexpr std::string_view before = "SRID=";
  if (!sameWord(token_.substr(0, before.size()), before)) return {};
  const std::string_view digits = token_.substr(before.size());
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (stop != digits.data() + digits.size() || error != std::errc()) {
    return wrong(fmt::format("{} is no number of a coordinate system", quoted(digits)));
  }
  code = number;
  next();
  return take(";") ? WktProblem() : expected("\";\"");
}

WktProblem WktTokens::takePosition(Point& point, bool& others) {
  std::array<double, 2> coordinate{};
  std::size_t count = 0;
  for (; !atEnd() && !is(",") && !is(")") && !is("("); ++count) {
    const auto number = parseNumber(token_);
    if (!number) return wrong(number.error());
    if (count < coordinate.size()) coordinate[count] = *number;
    next();
  }
  if (count < coordinate.size()) return expected("a number");
  others = others || count > coordinate.size();
  point = {coordinate[0], coordinate[1]};
  return {};
}

std::string WktTokens::wrong(std::string_view what) const {
  return fmt::format("{}: {}", placeOf(text_, place_), what);
}

std::string WktTokens::expected(std::string_view what) const {
  return wrong(atEnd() ? fmt::format("the text ends, where {} is needed", what)
                       : fmt::format("{}, where {} is needed", vorpipe::quoted(token_), what));
}

}  // namespace vorpipe
