#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "io/domain/outline_reader.h"
#include "io/files/error.h"
#include "io/text/number.h"

namespace vorpipe {
namespace {

/// What is wrong, beginning with line and column.
using Problem = std::optional<std::string>;

/// Words, numbers and signs, one after another.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) { next(); }

  [[nodiscard]] bool atEnd() const { return token_.empty(); }
  [[nodiscard]] std::string_view token() const { return token_; }
  [[nodiscard]] bool is(std::string_view word) const {
    return std::ranges::equal(
        token_, word, [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; });
  }

  void next() {
    const auto isBlank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    const auto isSign = [](char c) { return c == '(' || c == ')' || c == ',' || c == ';'; };
    place_ += token_.size();
    while (place_ < text_.size() && isBlank(text_[place_])) ++place_;
    std::size_t end = place_;
    while (end < text_.size() && !isBlank(text_[end]) && !isSign(text_[end])) ++end;
    if (end == place_ && end < text_.size()) ++end;
    token_ = text_.substr(place_, end - place_);
  }

  /// Takes the word and says so, if it is there.
  bool take(std::string_view word) {
    if (!is(word)) return false;
    next();
    return true;
  }

  [[nodiscard]] std::string wrong(std::string_view what) const {
    const std::string_view before = text_.substr(0, place_);
    const std::size_t line_end = before.rfind('\n');
    const std::size_t column = line_end == std::string_view::npos ? place_ : place_ - line_end - 1;
    return fmt::format("{}:{}: {}", 1 + std::ranges::count(before, '\n'), column + 1, what);
  }

  [[nodiscard]] std::string expected(std::string_view what) const {
    return wrong(atEnd() ? fmt::format("the text ends, where {} is needed", what)
                         : fmt::format("{}, where {} is needed", vorpipe::quoted(token_), what));
  }

 private:
  std::string_view text_, token_;
  std::size_t place_ = 0;
};

class Wkt {
 public:
  Wkt(std::string_view text, Outline& outline) : tokens_(text), outline_(outline) {}

  Problem all() {
    while (!tokens_.atEnd()) {
      if (auto problem = geometry()) return problem;
    }
    return {};
  }

 private:
  Problem geometry() {
    // PostGIS writes the coordinates' system before them.
    if (tokens_.token().starts_with("SRID=")) {
      tokens_.next();
      if (!tokens_.take(";")) return tokens_.expected("\";\"");
    }
    const bool several = tokens_.is("MULTIPOLYGON");
    if (!several && !tokens_.is("POLYGON")) return tokens_.expected("POLYGON or MULTIPOLYGON");
    tokens_.next();
    for (const std::string_view dimensions : {"Z", "M", "ZM"}) {
      if (tokens_.take(dimensions)) break;
    }
    return several ? list([&] { return polygon(); }) : polygon();
  }

  Problem polygon() {
    auto problem = list([&] { return ring(); });
    if (!problem) endPolygon(outline_);
    return problem;
  }

  Problem ring() {
    const Tokens begin = tokens_;
    std::vector<Point> points;
    if (auto problem = list([&] { return position(points); })) return problem;
    const auto added = addRing(std::move(points), outline_);
    return added ? Problem{} : begin.wrong(added.error());
  }

  /// x y, and what else there is of numbers.
  Problem position(std::vector<Point>& points) {
    double coordinate[2] = {0, 0};
    std::size_t count = 0;
    for (; !tokens_.atEnd() && !tokens_.is(",") && !tokens_.is(")") && !tokens_.is("("); ++count) {
      const auto number = parseNumber(tokens_.token());
      if (!number) return tokens_.wrong(number.error());
      if (count < 2) coordinate[count] = *number;
      tokens_.next();
    }
    if (count < 2) return tokens_.expected("a number");
    points.push_back({coordinate[0], coordinate[1]});
    return {};
  }

  /// Items in parentheses, or EMPTY.
  template <class Item>
  Problem list(const Item& item) {
    if (tokens_.take("EMPTY")) return {};
    if (!tokens_.take("(")) return tokens_.expected("\"(\"");
    do {
      if (auto problem = item()) return problem;
    } while (tokens_.take(","));
    if (!tokens_.take(")")) return tokens_.expected("\",\" or \")\"");
    return {};
  }

  Tokens tokens_;
  Outline& outline_;
};

}  // namespace

Result<Outline> readWktOutline(const std::string& name, std::string_view text) {
  Outline outline;
  if (const auto problem = Wkt(text, outline).all()) {
    return inputError(fmt::format("{}:{}", name, *problem));
  }
  return outline;
}

}  // namespace vorpipe
