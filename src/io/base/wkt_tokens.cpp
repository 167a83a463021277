#include "io/base/wkt_tokens.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <utility>

#include "io/base/error.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

constexpr std::array<std::string_view, 3> dimension_words = {"Z", "M", "ZM"};

bool sameWord(std::string_view text, std::string_view upper) {
  return std::ranges::equal(text, upper,
                            [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; });
}

}  // namespace

bool WktTokens::is(std::string_view word) const { return sameWord(token_, word); }

std::string wrongAt(WktPlace place, std::string_view what) {
  return fmt::format("{}:{}: {}", place.line, place.column, what);
}

/// Adds the next part of the file to text_; false if there is none.
bool WktTokens::refill() {
  if (file_ == nullptr || error_) return false;
  if (text_.size() > LineReader::longest_line) {
    error_ = refused(wrong(fmt::format("a word is longer than {} bytes; is this a text file?",
                                       LineReader::longest_line)))
                 .value();
    return false;
  }
  const std::size_t kept = text_.size();
  std::copy(text_.begin(), text_.end(), buffer_.begin());
  buffer_.resize(std::max(buffer_.size(), kept + chunk));
  const auto got = file_->read(std::span(buffer_).subspan(kept));
  if (!got) error_ = got.error();
  text_ = {buffer_.data(), kept + got.value_or(0)};
  if (!std::exchange(begun_, true)) text_ = withoutByteOrderMark(text_);
  return text_.size() > kept;
}

void WktTokens::next() {
  const auto isBlank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto isSign = [](char c) { return c == '(' || c == ')' || c == ',' || c == ';'; };
  text_.remove_prefix(token_.size());
  place_.column += token_.size();
  token_ = {};
  while (!text_.empty() || refill()) {
    if (!isBlank(text_.front())) break;
    const bool ends_line = text_.front() == '\n';
    place_ = ends_line ? WktPlace{place_.line + 1, 1} : WktPlace{place_.line, place_.column + 1};
    text_.remove_prefix(1);
  }
  std::size_t end = 0;
  while (end < text_.size() || refill()) {
    if (isBlank(text_[end]) || isSign(text_[end])) break;
    ++end;
  }
  if (error_) return;
  token_ = text_.substr(0, end == 0 ? 1 : end);
}

Result<void> WktTokens::end() const {
  return error_ ? Result<void>(tl::unexpected(*error_)) : Result<void>();
}

tl::unexpected<Error> WktTokens::refused(std::string_view problem) const {
  if (error_) return tl::unexpected(*error_);
  return inputError(fmt::format("{}:{}", file_ == nullptr ? "" : file_->name(), problem));
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
    return std::ranges::any_of(dimension_words,
                               [text](std::string_view word) { return sameWord(text, word); });
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
  const auto number = wholeNumber<std::int64_t>(digits);
  if (!number) return wrong(fmt::format("{} is no number of a coordinate system", inQuotes(digits)));
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

std::string WktTokens::wrong(std::string_view what) const { return wrongAt(place_, what); }

std::string WktTokens::expected(std::string_view what) const {
  return wrong(atEnd() ? fmt::format("the text ends, where {} is needed", what)
                       : fmt::format("{}, where {} is needed", vorpipe::inQuotes(token_), what));
}

}  // namespace vorpipe
