#include "view/words.h"

#include <utility>

namespace vorpipe::view {
namespace {

constexpr std::string_view blanks = " \t\r";

}  // namespace

tl::expected<std::vector<Word>, WordProblem> wordsOf(std::string_view line) {
  std::vector<Word> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(blanks, at)) != std::string_view::npos && line[at] != '#') {
    Word word{{}, at + 1};
    if (line[at] != '"') {
      const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
      word.text = line.substr(at, end - at);
      at = end;
    } else {
      for (++at; at < line.size() && line[at] != '"'; ++at) {
        const bool escaped = line[at] == '\\' && at + 1 < line.size();
        word.text += line[escaped ? ++at : at];
      }
      if (at == line.size()) return tl::unexpected(WordProblem{word.column, "the quote does not end"});
      ++at;
    }
    words.push_back(std::move(word));
  }
  return words;
}

std::string wordFor(std::string_view text) {
  const bool plain =
      !text.empty() && text.find_first_of(" \t\r\"\\") == std::string_view::npos && text[0] != '#';
  if (plain) return std::string(text);
  std::string word = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') word += '\\';
    word += letter;
  }
  return word + '"';
}

}  // namespace vorpipe::view
