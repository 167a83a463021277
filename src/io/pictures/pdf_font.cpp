#include "io/pictures/pdf_font.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "io/pictures/deflate.h"
#include "io/pictures/font_file.h"

// OpenType 1.9: the table directory; head, hhea, hmtx, and cmap in format 4. PDF Reference, third edition:
// 5.6 (composite fonts), 5.7 (descriptors), 5.8 (embedded programs), 5.9 (ToUnicode).

namespace vorpipe {
namespace {

constexpr std::string_view base_font = "VRPIPE+DejaVuSansCondensed";
constexpr char32_t unknown_letter = U'?';

/// A part of the font's file; its numbers have the high byte first.
class FontTable {
 public:
  explicit FontTable(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  /// The table of a font's file.
  static FontTable of(std::span<const unsigned char> file, std::string_view name) {
    constexpr std::size_t first = 12, entry = 16;
    const FontTable all(file);
    for (std::size_t k = 0; k < all.word(4); ++k) {
      const std::size_t at = first + k * entry;
      const std::string_view tag(reinterpret_cast<const char*>(file.data() + at), name.size());
      if (tag == name) return FontTable(file.subspan(all.longWord(at + 8), all.longWord(at + 12)));
    }
    return FontTable({});
  }

  [[nodiscard]] std::uint16_t word(std::size_t at) const {
    return static_cast<std::uint16_t>(bytes_[at] << 8 | bytes_[at + 1]);
  }
  [[nodiscard]] int signedWord(std::size_t at) const { return static_cast<std::int16_t>(word(at)); }
  [[nodiscard]] std::uint32_t longWord(std::size_t at) const {
    return static_cast<std::uint32_t>(word(at)) << 16 | word(at + 2);
  }
  [[nodiscard]] FontTable from(std::size_t at) const { return FontTable(bytes_.subspan(at)); }

 private:
  std::span<const unsigned char> bytes_;
};

/// Returns the glyphs of a cmap's first subtable for Unicode, which is of format 4.
std::map<char32_t, std::uint16_t> glyphsIn(const FontTable& cmap) {
  std::map<char32_t, std::uint16_t> glyphs;
  const FontTable table = cmap.from(cmap.longWord(8));
  const std::size_t twice = table.word(6);
  const std::size_t ends = 14, begins = ends + twice + 2, shifts = begins + twice, offsets = shifts + twice;
  for (std::size_t k = 0; k < twice; k += 2) {
    const std::uint32_t begin = table.word(begins + k), end = table.word(ends + k);
    const std::size_t offset = table.word(offsets + k);
    for (std::uint32_t letter = begin; letter <= end && letter < 0xFFFF; ++letter) {
      const std::uint32_t found =
          offset == 0 ? letter : table.word(offsets + k + offset + std::size_t{letter - begin} * 2);
      const auto glyph = static_cast<std::uint16_t>(found == 0 ? 0 : found + table.word(shifts + k));
      if (glyph != 0) glyphs[letter] = glyph;
    }
  }
  return glyphs;
}

/// Returns the letters of UTF-8; bytes that are none are unknown letters.
std::vector<char32_t> lettersOf(std::string_view text) {
  std::vector<char32_t> letters;
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at++]);
    if (first < 0x80) {
      letters.push_back(first);
      continue;
    }
    int rest = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
    char32_t letter = first & (0x3F >> rest);
    bool whole = rest > 0;
    for (; whole && rest > 0; --rest) {
      whole = at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
      if (whole) letter = letter << 6 | (static_cast<unsigned char>(text[at++]) & 0x3F);
    }
    letters.push_back(whole ? letter : unknown_letter);
  }
  return letters;
}

std::string streamOf(std::string_view bytes) {
  const std::string packed = deflated(bytes);
  return fmt::format("<< /Length {} /Length1 {} /Filter /FlateDecode >>\nstream\n{}\nendstream",
                     packed.size(), bytes.size(), packed);
}

}  // namespace

PdfFont::PdfFont() {
  const auto file = fontFile();
  const FontTable head = FontTable::of(file, "head"), hhea = FontTable::of(file, "hhea");
  const FontTable hmtx = FontTable::of(file, "hmtx"), maxp = FontTable::of(file, "maxp");
  units_ = head.word(18);
  left_ = head.signedWord(36);
  bottom_ = head.signedWord(38);
  right_ = head.signedWord(40);
  top_ = head.signedWord(42);
  ascent_ = hhea.signedWord(4);
  descent_ = hhea.signedWord(6);
  const std::size_t measured = hhea.word(34), count = maxp.word(4);
  // The last ones are as wide as each other.
  for (std::size_t k = 0; k < count; ++k) widths_.push_back(hmtx.word(4 * std::min(k, measured - 1)));
  glyphs_ = glyphsIn(FontTable::of(file, "cmap"));
}

bool PdfFont::has(std::string_view text) const {
  return std::ranges::all_of(lettersOf(text), [&](char32_t letter) { return glyphs_.contains(letter); });
}

std::vector<std::uint16_t> PdfFont::glyphsOf(std::string_view text) const {
  std::vector<std::uint16_t> glyphs;
  for (const char32_t letter : lettersOf(text)) {
    const auto found = glyphs_.find(letter);
    glyphs.push_back(found != glyphs_.end() ? found->second : glyphs_.at(unknown_letter));
  }
  return glyphs;
}

double PdfFont::widthOf(std::string_view text) const {
  double width = 0;
  for (const std::uint16_t glyph : glyphsOf(text)) width += widths_[glyph];
  return width / units_;
}

void PdfFont::print(Bytes& bytes, std::string_view text) const {
  bytes.push_back('<');
  for (const std::uint16_t glyph : glyphsOf(text)) vorpipe::print(bytes, FMT_COMPILE("{:04X}"), glyph);
  bytes.push_back('>');
}

std::string PdfFont::widthsText() const {
  constexpr double thousand = 1000;
  std::string text = "[0 [";
  for (const std::uint16_t width : widths_)
    text += fmt::format("{} ", std::lround(thousand * width / units_));
  return text + "]]";
}

std::string PdfFont::unicodeText() const {
  constexpr std::size_t most_at_once = 100;
  std::string text =
      "/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n"
      "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
      "/CMapName /Adobe-Identity-UCS def /CMapType 2 def\n"
      "1 begincodespacerange <0000> <FFFF> endcodespacerange\n";
  std::size_t left = glyphs_.size(), here = 0;
  for (const auto& [letter, glyph] : glyphs_) {
    if (here == 0) {
      here = std::min(left, most_at_once);
      text += fmt::format("{} beginbfchar\n", here);
    }
    text += fmt::format("<{:04X}> <{:04X}>\n", glyph, static_cast<std::uint32_t>(letter));
    --left;
    if (--here == 0) text += "endbfchar\n";
  }
  return text + "endcmap CMapName currentdict /CMap defineresource pop end end\n";
}

std::vector<std::string> PdfFont::objects(int first) const {
  const auto thousandths = [&](double units) { return std::lround(1000 * units / units_); };
  const auto file = fontFile();
  return {
      fmt::format("<< /Type /Font /Subtype /Type0 /BaseFont /{} /Encoding /Identity-H\n"
                  "/DescendantFonts [{} 0 R] /ToUnicode {} 0 R >>",
                  base_font, first + 1, first + 2),
      fmt::format("<< /Type /Font /Subtype /CIDFontType2 /BaseFont /{} /CIDToGIDMap /Identity\n"
                  "/CIDSystemInfo << /Registry (Adobe) /Ordering (Identity) /Supplement 0 >>\n"
                  "/FontDescriptor {} 0 R /W {} >>",
                  base_font, first + 3, widthsText()),
      streamOf(unicodeText()),
      fmt::format("<< /Type /FontDescriptor /FontName /{} /Flags 32 /FontBBox [{} {} {} {}] /ItalicAngle 0\n"
                  "/Ascent {} /Descent {} /CapHeight {} /StemV 90 /FontFile2 {} 0 R >>",
                  base_font, thousandths(left_), thousandths(bottom_), thousandths(right_), thousandths(top_),
                  thousandths(ascent_), thousandths(descent_), std::lround(1000 * capital_height), first + 4),
      streamOf({reinterpret_cast<const char*>(file.data()), file.size()})};
}

}  // namespace vorpipe
