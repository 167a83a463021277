#include "cli/options/reading_options.h"

#include <fmt/core.h>

#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

/// One to three names or numbers, separated by commas.
Parsed<std::vector<std::string>> parseColumns(std::string_view text) {
  std::vector<std::string> columns;
  std::string_view rest = text;
  while (true) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    columns.emplace_back(rest.substr(0, end));
    if (columns.back().empty() || columns.size() > 3) {
      return tl::unexpected(
          fmt::format("{} is not X,Y or X,Y,W or one column of WKT", vorpipe::inQuotes(text)));
    }
    if (end == rest.size()) return columns;
    rest.remove_prefix(end + 1);
  }
}

Parsed<bool> parseMissing(std::string_view text) {
  if (text == "skip") return true;
  return tl::unexpected(fmt::format("{} is not skip", vorpipe::inQuotes(text)));
}

}  // namespace

void addReadingOptions(Options& options, InputOptions& input, const Option& sites) {
  input.reading.attributes = false;
  addParsed(
      options, "--columns", input.reading.columns, "X,Y[,W]",
      "columns of the file's positions and weights, by name, in any case, or by number from 1; one alone has "
      "points in WKT [as the header says]",
      parseColumns)
      .needs(sites);
  addParsed(options, "--missing", input.reading.skip_missing, "skip",
            "leaves out rows without a place or a weight, and counts them [they are errors]", parseMissing,
            {{"skip"}, {}})
      .needs(sites);
  options.addText("--layer", input.reading.layer, "NAME", "layer of a GeoPackage [its only one with points]")
      .needs(sites);
  addParsed(options, "--format", input.format, "KIND",
            "kind of file that comes by standard input, and goes to standard output: its extension without "
            "the dot, "
            "or two as in csv,geojson [csv]",
            parseFormat);
}

}  // namespace vorpipe::cli
