#include "picture/glyphs.h"

#include <array>

namespace vorpipe::core {
namespace {

constexpr auto glyphs = std::to_array<Glyph>({
    {U' ', 4, ""},
    {U'0', 6, "~4m8m8a0a0m4m"},
    {U'1', 6, "1k4m4a 1a7a"},
    {U'2', 6, "~0j0m8m8g0a 0a8a"},
    {U'3', 6, "~0k0m8m8g3g ~3g8g8a0a0c"},
    {U'4', 6, "6a6m0e8e"},
    {U'5', 6, "8m0m0i ~0i8i8a0a0c"},
    {U'6', 6, "~8k8m0m0a8a8h0h"},
    {U'7', 6, "0m8m2a"},
    {U'8', 6, "~4m8m8g0g0m4m ~4g8g8a0a0g4g"},
    {U'9', 6, "~0c0a8a8m0m0f8f"},
    {U'A', 6, "0a4m8a 2e6e"},
    {U'B', 6, "~0m7m7g0g ~0g8g8a0a 0a0m"},
    {U'C', 6, "~8k8m0m0a8a8c"},
    {U'D', 6, "~0m8m8a0a 0a0m"},
    {U'E', 6, "8m0m0a8a 0g6g"},
    {U'F', 6, "8m0m0a 0g6g"},
    {U'G', 6, "~8k8m0m0a8a8f 8f5f"},
    {U'H', 6, "0a0m 8a8m 0g8g"},
    {U'I', 4, "0a4a 0m4m 2a2m"},
    {U'J', 6, "~8m8a0a0d"},
    {U'K', 6, "0a0m 8m0e 2g8a"},
    {U'L', 6, "0m0a8a"},
    {U'M', 6, "0a0m4e8m8a"},
    {U'N', 6, "0a0m8a8m"},
    {U'O', 7, "~5m:m:a0a0m5m"},
    {U'P', 6, "0a0m ~0m8m8f0f"},
    {U'Q', 7, "~5m:m:a0a0m5m 6d:a"},
    {U'R', 6, "0a0m ~0m8m8g0g 4g8a"},
    {U'S', 6, "~8k8m0m0g8g8a0a0c"},
    {U'T', 6, "4a4m 0m8m"},
    {U'U', 6, "~0m0a8a8m"},
    {U'V', 6, "0m4a8m"},
    {U'W', 6, "0m2a4i6a8m"},
    {U'X', 6, "0m8a 0a8m"},
    {U'Y', 6, "0m4g8m 4g4a"},
    {U'Z', 6, "0m8m0a8a"},
    {U'a', 6, "~0i8i8a ~8e0e0a8a"},
    {U'b', 6, "0m0a ~0i8i8a0a"},
    {U'c', 6, "~8g8i0i0a8a8c"},
    {U'd', 6, "8m8a ~8i0i0a8a"},
    {U'e', 6, "0e8e ~8e8i0i0a8a8b"},
    {U'f', 5, "~2a2m6m 0i5i"},
    {U'g', 6, "~8i0i0a8a ~8i8D0D"},
    {U'h', 6, "0m0a ~0i8i8a"},
    {U'i', 2, "0i0a 0l0m"},
    {U'j', 4, "~4i4D0D 4l4m"},
    {U'k', 6, "0m0a 7i0d 2f8a"},
    {U'l', 2, "0m0a"},
    {U'm', 6, "0i0a ~0i4i4a ~4i8i8a"},
    {U'n', 6, "0i0a ~0i8i8a"},
    {U'o', 6, "~4i8i8a0a0i4i"},
    {U'p', 6, "0i0D ~0i8i8a0a"},
    {U'q', 6, "8i8D ~8i0i0a8a"},
    {U'r', 5, "0i0a ~0e0i6i"},
    {U's', 6, "~8h8i0i0e8e8a0a0b"},
    {U't', 5, "~2l2a6a 0i5i"},
    {U'u', 6, "8i8a ~0i0a8a"},
    {U'v', 6, "0i4a8i"},
    {U'w', 6, "0i2a4g6a8i"},
    {U'x', 6, "0i8a 0a8i"},
    {U'y', 6, "0i4a 8i3D1D"},
    {U'z', 6, "0i8i0a8a"},
    {U'.', 2, "0a0a"},
    {U',', 3, "2a0C"},
    {U':', 2, "0b0b 0h0h"},
    {U'/', 6, "0a8m"},
    {U'=', 6, "0e8e 0i8i"},
    {U'_', 6, "0A8A"},
    {U'-', 6, "1g7g"},
    {U'+', 6, "0g8g 4c4k"},
    {U'%', 6, "8m0a ~1m3m3j0j0m1m ~7d8d8a5a5d7d"},
    {U'(', 3, "~2n0n0B2B"},
    {U')', 3, "~0n2n2B0B"},
    {U'!', 2, "0m0e 0a0a"},
    {U'"', 4, "0m0j 3m3j"},
    {U'#', 6, "2a3m 5a6m 0e8e 0i8i"},
    {U'$', 6, "~8k8l0l0g8g8b0b0c 4n4A"},
    {U'&', 6, "~8e5a0a0f6j6m2m2j8a"},
    {U'\'', 2, "0m0j"},
    {U'*', 6, "4d4j 1f7i 1i7f"},
    {U';', 3, "2a0C 2h2h"},
    {U'<', 6, "8j0f8b"},
    {U'>', 6, "0j8f0b"},
    {U'?', 6, "~0k0m8m8g4g4e 4a4a"},
    {U'@', 6, "~8b8a0a0m8m8d5d5i8i"},
    {U'[', 4, "3n0n0B3B"},
    {U'\\', 6, "0m8a"},
    {U']', 4, "0n3n3B0B"},
    {U'^', 6, "1j4m7j"},
    {U'`', 4, "0m3k"},
    {U'{', 4, "4n2n2h0f2d2B4B"},
    {U'|', 2, "0n0B"},
    {U'}', 4, "0n2n2h4f2d2B0B"},
    {U'~', 6, "~0e0h4h4f8f8i"},
    {U'\u00A0', 4, ""},
    {U'\u00A1', 2, "0i0i 0f0D"},
    {U'\u00A3', 6, "~8k8m3m3a 0a8a 0g6g"},
    {U'\u00AB', 6, "4i1e4a 8i5e8a"},
    {U'\u00B0', 4, "~2m4m4i0i0m2m"},
    {U'\u00B1', 6, "0h8h 4d4l 0a8a"},
    {U'\u00B2', 4, "~0l0m4m4j 4j0g4g"},
    {U'\u00B3', 4, "~0m4m4j1j ~1j4j4g0g"},
    {U'\u00B5', 6, "0i0D ~0c0a8a 8i8a"},
    {U'\u00B7', 2, "0f0f"},
    {U'\u00BB', 6, "0i3e0a 4i7e4a"},
    {U'\u00BF', 6, "4i4i ~4f4d0d0D8D8B"},
    {U'\u00C6', 6, "0a4m8m 4m4a8a 4g7g 2e4e"},
    {U'\u00D0', 6, "~0m8m8a0a 0a0m 0g4g"},
    {U'\u00D7', 6, "1c7i 1i7c"},
    {U'\u00D8', 7, "~5m:m:a0a0m5m 1a9m"},
    {U'\u00DE', 6, "0a0m ~0k8k8d0d"},
    {U'\u00DF', 6, "~0a0m6m6h3h ~3h8h8a3a"},
    {U'\u00E6', 6, "~0i4i4a ~4e0e0a4a 4e8e ~4i8i8e 4a8a"},
    {U'\u00F0', 6, "~4h8h8a0a0h4h 8f2m 2j6m"},
    {U'\u00F7', 6, "0f8f 4i4i 4c4c"},
    {U'\u00F8', 6, "~4i8i8a0a0i4i 0a8i"},
    {U'\u00FE', 6, "0m0D ~0i8i8a0a"},
    {U'\u0110', 6, "~0m8m8a0a 0a0m 0g4g"},
    {U'\u0111', 6, "8m8a ~8i0i0a8a 5l9l"},
    {U'\u0126', 6, "0a0m 8a8m 0g8g 0j8j"},
    {U'\u0127', 6, "0m0a ~0i8i8a 0k4k"},
    {U'\u0131', 4, "2i2a"},
    {U'\u0141', 6, "2m2a8a 0e6i"},
    {U'\u0142', 4, "2m2a 0e4i"},
    {U'\u014A', 6, "0a0m ~0m8m8B5B"},
    {U'\u014B', 6, "0i0a ~0i8i8D5D"},
    {U'\u0152', 6, "~4m0m0a4a 4m8m 4m4a 4a8a 4g7g"},
    {U'\u0153', 6, "~4i0i0a4a 4i4a 4e8e ~4i8i8e 4a8a"},
    {U'\u0166', 6, "4a4m 0m8m 2g6g"},
    {U'\u0167', 5, "~2l2a6a 0i5i 0e5e"},
    {U'\u0237', 4, "~4i4D0D"},
    {U'\u2013', 6, "0g8g"},
    {U'\u2014', 6, "0g8g"},
    {U'\u2018', 3, "0m2j"},
    {U'\u2019', 3, "2m0j"},
    {U'\u201C', 5, "0m2j 4m6j"},
    {U'\u201D', 5, "2m0j 6m4j"},
    {U'\u201E', 5, "2a0C 6a4C"},
    {U'\u2026', 6, "0a0a 4a4a 8a8a"},
    {U'\u20AC', 6, "~8l8m2m2a8a8b 0h6h 0e6e"},
});

/// Letters with marks from U+00C0 to U+017F: two characters each, the letter and its mark; blanks where a
/// character has a glyph of its own, or none.
constexpr std::u32string_view first_marked = U"\u00C0";
constexpr std::string_view marked_letters =
    "A`A'A^A~A:Ao  C,E`E'E^E:I`I'I^I:  N~O`O'O^O~O:    U`U'U^U:Y'    "
    "a`a'a^a~a:ao  c,e`e'e^e:i`i'i^i:  n~o`o'o^o~o:    u`u'u^u:y'  y:"
    "A-a-AuauA;a;C'c'C^c^C.c.CvcvDvd|    E-e-EueuE.e.E;e;EvevG^g^Gugu"
    "G.g.G,g'H^h^    I~i~I-i-IuiuI;i;I.      J^j^K,k,  L'l'L,l,L|l|  "
    "      N'n'N,n,Nvnv      O-o-OuouO\"o\"    R'r'R,r,RvrvS's'S^s^S,s,"
    "SvsvT,t,Tvt|    U~u~U-u-UuuuUouoU\"u\"U;u;W^w^Y^y^Y:Z'z'Z.z.Zvzv  ";
static_assert(marked_letters.size() == std::size_t{0x180 - 0xC0} * 2);

constexpr auto accents = std::to_array<Mark>({
    {'`', true, "2f5c"},
    {'\'', true, "3c6f"},
    {'^', true, "2c4f6c"},
    {'~', true, "1c2e3e5c6c7e"},
    {':', true, "2d2d 6d6d"},
    {'o', true, "~4f6f6c2c2f4f"},
    {'-', true, "2d6d"},
    {'u', true, "~2f2c6c6f"},
    {'.', true, "4d4d"},
    {'v', true, "2f4c6f"},
    {'"', true, "2c3f 5c6f"},
    {',', false, "4B5D3D"},
    {';', false, "5A4D6D"},
    {'|', false, ":m9j"},
});

const Glyph* glyphOf(char32_t character) {
  const auto* found = std::ranges::find(glyphs, character, &Glyph::character);
  return found == glyphs.end() ? nullptr : found;
}

}  // namespace

Letter letterOf(char32_t character) {
  if (const Glyph* glyph = glyphOf(character)) return {glyph};
  constexpr char32_t first_romanian = 0x218, last_romanian = 0x21B;
  std::string_view parts = "  ";
  if (character >= first_marked[0] && character - first_marked[0] < marked_letters.size() / 2) {
    parts = marked_letters.substr(std::size_t{character - first_marked[0]} * 2, 2);
  } else if (character >= first_romanian && character <= last_romanian) {
    parts = std::string_view("S,s,T,t,").substr(std::size_t{character - first_romanian} * 2, 2);
  }
  if (parts == "  ") return {nullptr};
  const auto base = static_cast<unsigned char>(parts[0]);
  const auto* mark = std::ranges::find(accents, parts[1], &Mark::name);
  // Letters lose their dots to marks above them.
  constexpr char32_t dotless_i = 0x131, dotless_j = 0x237;
  const bool loses = mark->above && (base == 'i' || base == 'j');
  return {glyphOf(!loses ? base : base == 'i' ? dotless_i : dotless_j), mark};
}

Letter drawnLetter(char32_t character) {
  const Letter letter = letterOf(character);
  return letter.glyph != nullptr ? letter : Letter{&glyphs.front()};
}

}  // namespace vorpipe::core
