/// The font of texts in a PDF: embedded, since printers may have no other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/print.h"

namespace vorpipe {

/// fontFile(), as PDF asks for it. Letters that it does not have become a question mark.
class PdfFont {
 public:
  PdfFont();

  /// Height of a capital letter, in ems.
  static constexpr double capital_height = 0.729;

  [[nodiscard]] bool has(std::string_view text) const;
  /// Returns the width of a text in UTF-8, in ems.
  [[nodiscard]] double widthOf(std::string_view text) const;
  /// Appends a text as a string of PDF.
  void print(Bytes& bytes, std::string_view text) const;

  /// Returns the objects of the font, of which the first is the font, the others follow it; `first` is its
  /// number.
  [[nodiscard]] std::vector<std::string> objects(int first) const;

 private:
  [[nodiscard]] std::vector<std::uint16_t> glyphsOf(std::string_view text) const;
  [[nodiscard]] std::string widthsText() const;
  [[nodiscard]] std::string unicodeText() const;

  double units_ = 1;                          ///< of an em
  std::vector<std::uint16_t> widths_;         ///< by glyph, in these units
  std::map<char32_t, std::uint16_t> glyphs_;  ///< by letter
  int left_ = 0, bottom_ = 0, right_ = 0, top_ = 0, ascent_ = 0, descent_ = 0;
};

}  // namespace vorpipe
