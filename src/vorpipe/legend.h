/// Layout and content of a picture's legend: the same for pixels, SVG and PDF.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe/picture.h"
#include "vorpipe/shapes.h"

namespace vorpipe {

/// The smallest picture, in either direction, that a legend fits into.
inline constexpr PictureSize least_with_legend{100, 64};

/// In pixels from the picture's upper left corner, y downward.
struct LegendBox {
  double left, top, width, height;
  std::uint32_t rgba;  ///< R in the lowest byte; may be translucent
};

/// Whether pictures of pixels can show all characters of a text: ASCII, Latin letters with their accents, and
/// some signs. Pictures of shapes leave letters to the viewer.
bool pixelsHaveLetters(std::string_view text);

/// Error (input): a text of a picture, of a label or around it, has letters that `has` does not accept;
/// `what` is the picture, for the message.
Result<void> checkLetters(const RenderOptions& options, std::string_view what,
                          const std::function<bool(std::string_view)>& has);

enum class Anchor : std::uint8_t { start, middle, end };

struct LegendText {
  double x, baseline;
  double height;  ///< of a capital letter
  Anchor anchor;
  std::string text;  ///< UTF-8
  std::uint32_t rgba = black;
  std::optional<std::uint32_t> halo{};  ///< halo_part wide; drawText() draws none
};

/// Returns how wide a text is when drawText() draws it, in pixels.
double widthOf(const LegendText& text);

/// Draws a text in its color over pixels, smoothed. Its height is rounded to a multiple of 7 pixels.
void drawText(const LegendText& text, Image& image);

/// Boxes are drawn first, each over the previous ones; then texts.
struct Legend {
  std::vector<LegendBox> boxes;
  std::vector<LegendText> texts;
};

/// Returns the legend of a picture, in its lower left corner. `key` describes its colors.
Legend legendOf(const ColorKey& key, const RenderOptions& options);

/// What stands around a picture: its title above, its legend beside it. Without them there are no margins.
struct Sheet {
  int left = 0, top = 0, right = 0, bottom = 0;  ///< margins in pixels
  Legend legend{};  ///< in pixels from the picture's upper left corner; less than 0 in the margins
};

/// Returns the sheet of a picture; `key` describes its colors, if they stand for something.
Sheet sheetOf(const RenderOptions& options, const std::optional<ColorKey>& key);

/// Returns the size of the sheet on paper, if the picture has one: its pixels are as large.
std::optional<PaperSize> paperOf(const RenderOptions& options, const Sheet& sheet);

/// Returns the picture in the middle of its sheet, without ids.
Image onSheet(const Image& picture, const Sheet& sheet);

}  // namespace vorpipe
