/// Well-known text, token by token, and what all geometries in it have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

/// What is wrong, beginning with line and column.
using WktProblem = std::optional<std::string>;

/// Words, numbers and signs, one after another.
class WktTokens {
 public:
  explicit WktTokens(std::string_view text) : text_(text) { next(); }

  [[nodiscard]] bool atEnd() const { return token_.empty(); }
  [[nodiscard]] std::string_view token() const { return token_; }
  /// Whether the token is a word, which is given in upper case.
  [[nodiscard]] bool is(std::string_view word) const;

  void next();

  /// Takes the word and says so, if it is there.
  bool take(std::string_view word);

  /// Takes the name of a geometry and what follows of its dimensions, as in "POINT Z" and "POINTZ".
  bool takeType(std::string_view name);

  /// Takes "SRID=4326;", which PostGIS writes before a geometry, if it is there, and keeps the number.
  WktProblem takeSystem(std::optional<std::int64_t>& code);

  /// Takes x y, and what else there is of numbers, of which `others` then tells.
  WktProblem takePosition(Point& point, bool& others);

  /// Takes items in parentheses, or EMPTY; `item` takes one and returns what is wrong with it.
  template <class Item>
  WktProblem takeList(const Item& item) {
    if (take("EMPTY")) return {};
    if (!take("(")) return expected("\"(\"");
    do {
      if (auto problem = item()) return problem;
    } while (take(","));
    if (!take(")")) return expected("\",\" or \")\"");
    return {};
  }

  /// "LINE:COLUMN: what" about the token.
  [[nodiscard]] std::string wrong(std::string_view what) const;
  [[nodiscard]] std::string expected(std::string_view what) const;

 private:
  std::string_view text_, token_;
  std::size_t place_ = 0;
};

}  // namespace vorpipe
