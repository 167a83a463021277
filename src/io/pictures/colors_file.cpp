#include "io/pictures/colors_file.h"

#include <fmt/core.h>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {

Result<std::vector<Color>> readColors(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  LineReader lines(std::move(file));
  std::vector<Color> colors;
  while (true) {
    VORPIPE_LET(line, lines.next());
    if (!line) break;
    const std::string_view text = trimmed(*line);
    if (text.empty()) continue;
    const std::size_t column = static_cast<std::size_t>(text.data() - line->data()) + 1;
    const auto color = readColor(text);
    if (!color) return lines.errorAt(column, color.error().message);
    if (!color->isOpaque()) return lines.errorAt(column, fmt::format("{} is not opaque", inQuotes(text)));
    if (colors.size() == most_colors)
      return lines.errorAt(column, fmt::format("more than {} colors", most_colors));
    colors.push_back(*color);
  }
  if (colors.size() < 2)
    return inputError(fmt::format("{}: has {} colors, and takes two or more", path, colors.size()));
  return colors;
}

}  // namespace vorpipe
