/// Well-known text, token by token, and the parts common to all geometries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/input_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// What is wrong, beginning with line and column.
using WktProblem = std::optional<std::string>;

/// Position of a token; both counted from 1.
struct WktPlace {
  std::uint64_t line = 1, column = 1;
};

/// "LINE:COLUMN: what".
std::string wrongAt(WktPlace place, std::string_view what);

/// Words, numbers and signs, one after another.
class WktTokens {
 public:
  explicit WktTokens(std::string_view text) : text_(text) { next(); }
  /// Reads a file, which is not kept: a token is valid until the next one.
  explicit WktTokens(InputFile& file) : file_(&file), buffer_(chunk) { next(); }
  WktTokens(const WktTokens&) = delete;
  WktTokens& operator=(const WktTokens&) = delete;

  /// Whether all tokens were taken, or reading the file failed.
  [[nodiscard]] bool atEnd() const { return token_.empty(); }
  /// Checks that the end is that of the file. Errors: those of reading; a word has no end (input).
  [[nodiscard]] Result<void> end() const;
  /// "FILE:problem" as an input error, or why reading the file failed.
  [[nodiscard]] tl::unexpected<Error> refused(std::string_view problem) const;
  [[nodiscard]] WktPlace place() const { return place_; }
  [[nodiscard]] std::string_view token() const { return token_; }
  /// Whether the token is `word`, given in upper case.
  [[nodiscard]] bool is(std::string_view word) const;

  void next();

  /// Takes the word if it is next, and returns whether it was.
  bool take(std::string_view word);

  /// Takes the name of a geometry and its dimension suffix, as in "POINT Z" and "POINTZ".
  bool takeType(std::string_view name);

  /// Takes "SRID=4326;", which PostGIS writes before a geometry, if it is there, and keeps the number.
  WktProblem takeSystem(std::optional<std::int64_t>& code);

  /// Takes x y and any further numbers; `others` reports whether there are any.
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
  static constexpr std::size_t chunk = std::size_t{1} << 16;

  bool refill();

  std::string_view text_, token_;  ///< token_ is where text_ begins
  WktPlace place_;                 ///< of token_
  InputFile* file_ = nullptr;      ///< none: text_ is all there is
  std::vector<char> buffer_;       ///< that text_ is in
  bool begun_ = false;
  std::optional<Error> error_;
};

}  // namespace vorpipe
