#include "cli/options/domain_options.h"

#include <fmt/format.h>

#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/outline_file.h"

namespace vorpipe::cli {

Parsed<Margin> parseMargin(std::string_view text) {
  constexpr double percent = 100;
  const bool relative = text.ends_with('%');
  const auto number = parseNumber(relative ? text.substr(0, text.size() - 1) : text);
  if (!number || !(*number >= 0)) {
    return tl::unexpected(
        fmt::format("{} is neither a number of 0 or more nor one with %, as in 10%", inQuotes(text)));
  }
  return Margin{relative ? *number / percent : *number, relative};
}

Parsed<ProjectChoice> parseProject(std::string_view text) {
  if (text == "auto") return ProjectChoice{};
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) {
    return tl::unexpected(
        fmt::format("{} is neither auto nor LON,LAT, degrees of a center, as in 12.5,42", inQuotes(text)));
  }
  const auto longitude = parseNumber(text.substr(0, comma)), latitude = parseNumber(text.substr(comma + 1));
  if (!longitude) return tl::unexpected("LON: " + longitude.error());
  if (!latitude) return tl::unexpected("LAT: " + latitude.error());
  const Point center{*longitude, *latitude};
  if (auto projection = Projection::around(center); !projection) {
    return tl::unexpected(std::move(projection.error().message));
  }
  return ProjectChoice{center};
}

void addDomainOptions(Options& options, InputOptions& input, const Option& sites) {
  addParsed(options, "--domain", input.domain, "BOX, FILE or hull",
            fmt::format(
                "what is drawn and measured: the box XMIN,YMIN,XMAX,YMAX [0,0,1,1; for files the box of the "
                "sites and a --margin], a file with its outline, polygons with holes ({}), which are "
                "dissolved where "
                "they touch or overlap, or the convex hull of the sites; generators fill the box, or the "
                "square around an outline",
                anyOf(outlineExtensions())),
            parseDomain, {{"hull"}, outlineExtensions()})
      .needs(sites);
  options
      .addText("--domain-layer", input.domain_layer, "NAME",
               "layer of a GeoPackage with the outline [its only one with polygons]")
      .needs(sites);
  addParsed(
      options, "--margin", input.margin, "M or P%",
      "margin around the sites, where --domain names no box, or around their hull: in the domain's unit, or "
      "as a part of the longer side [5%; of a hull 0]",
      parseMargin)
      .needs(sites);
  options
      .addFlag("--repair", input.repair,
               "mends polygons of --domain that cross themselves, and says what it changed")
      .needs(sites);
  addParsed(
      options, "--project", input.project, "auto or LON,LAT",
      "the sites and the domain are in degrees: cells are made in an equal-area plane around their middle, "
      "or around LON,LAT; positions come back in degrees, areas in square kilometers",
      parseProject, {{"auto"}, {}})
      .needs(sites);
}

}  // namespace vorpipe::cli
