/// The letters of the font: the strokes of the pen for each character.
#pragma once

#include <algorithm>
#include <string_view>

namespace vorpipe::core {

/// A character: its width in units including the gap after it, and the strokes of the pen. A stroke is a list
/// of points, each a digit and a letter: x in half units from the left, and y in half units above the
/// baseline from a on, or below it from A on. Strokes are separated by spaces; ~ rounds the corners.
struct Glyph {
  char32_t character;
  int advance;
  std::string_view strokes;
};

/// A mark: its strokes, around x = 4; those above a letter stand on y = a.
struct Mark {
  char name;
  bool above;
  std::string_view strokes;
};

/// What is drawn for a character.
struct Letter {
  const Glyph* glyph;  ///< null if there is none
  const Mark* mark = nullptr;
};

Letter letterOf(char32_t character);

/// The same, of a character without a glyph a blank.
Letter drawnLetter(char32_t character);

/// Calls `use` with each character of UTF-8; what is no UTF-8 is one of no glyph.
template <class Use>
void eachCharacter(std::string_view text, const Use& use) {
  constexpr char32_t strange = 0xFFFD;
  while (!text.empty()) {
    const auto lead = static_cast<unsigned char>(text[0]);
    const std::size_t size = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    char32_t character = size == 1 ? lead : lead & (0x7FU >> size);
    for (std::size_t k = 1; k < size && k < text.size(); ++k) {
      character = character << 6 | (static_cast<unsigned char>(text[k]) & 0x3F);
    }
    use(size <= text.size() ? character : strange);
    text.remove_prefix(std::min(size, text.size()));
  }
}

}  // namespace vorpipe::core
