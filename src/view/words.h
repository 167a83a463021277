/// The words of a line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace vorpipe::view {

struct Word {
  std::string text;
  std::size_t column = 1;  ///< column of its first byte, from 1
};

struct WordProblem {
  std::size_t column = 1;
  std::string what;
};

/// Splits a line into words at blanks. A word in double quotes may contain blanks; in it \" is a quote, and
/// \\ a backslash. A word that begins with # ends the line.
tl::expected<std::vector<Word>, WordProblem> wordsOf(std::string_view line);

/// Returns a word as wordsOf reads it: quoted if necessary.
std::string wordFor(std::string_view text);

}  // namespace vorpipe::view
