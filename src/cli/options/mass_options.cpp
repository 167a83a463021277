#include "cli/options/mass_options.h"

#include <fmt/format.h>

#include "base/try.h"
#include "cli/options/options.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

/// The source of masses: one of the two, or none for equal masses.
struct MassSource {
  std::string file, attribute;
};

Parsed<MassSource> parseMasses(std::string_view text) {
  if (text == "equal") return MassSource{};
  if (text == "@") return tl::unexpected(std::string("no attribute is named after @"));
  if (text.starts_with('@')) return MassSource{{}, std::string(text.substr(1))};
  return parseFile(text, "").map([](const std::string& path) { return MassSource{path, {}}; });
}

Parsed<std::optional<double>> parseFill(std::string_view text) {
  VORPIPE_LET(part, parseNumber(text));
  if (part > 0 && part < 1) return part;
  return tl::unexpected(fmt::format("{} is not a part of the domain, between 0 and 1", part));
}

Parsed<Surface> parseSurface(std::string_view text) {
  if (text == "free") return Surface::free;
  return tl::unexpected(fmt::format("{} is not free", vorpipe::inQuotes(text)));
}

}  // namespace

void addSurface(Options& options, Surface& surface, const std::string& text) {
  addParsed(options, "--surface", surface, "free", text, parseSurface, {{"free"}, {}});
}

void addMassOptions(Options& options, MassOptions& masses) {
  options.group("Masses");
  const auto keep = [&masses](MassSource source) {
    masses.file = std::move(source.file);
    masses.attribute = std::move(source.attribute);
  };
  options.add(
      "--masses", parsedValue("FILE", parseMasses, keep, {{"equal", "@"}, {".txt", ".csv", ".npy"}}),
      "the mass of each site's cell, its area where there is no density: a number to a line of a .txt "
      "or .csv, or an .npy; or @NAME, an attribute of the sites; or equal [equal]");
  options.addFlag("--skip-zero", masses.skip_zero,
                  "leaves out sites whose mass is 0, which can have no cell, and says how many");
  options.addFlag("--normalize", masses.normalize,
                  "scales the masses so that they add up to what the domain has");
  addSurface(
      options, masses.surface,
      "lets the cells end in air: each is cut by a disc around its site, and masses may add up to less "
      "than the domain has [cells fill it]");
  addParsed(options, "--fill", masses.fill, "V",
            "a free surface, and this part of what the domain has for all cells together, 0 to 1: masses are "
            "scaled to it",
            parseFill);
}

Result<void> checkMasses(const MassOptions& masses) {
  if (masses.normalize && masses.areEqual()) {
    return inputError("--normalize: scales what --masses names; equal masses add up by themselves");
  }
  if (masses.skip_zero && masses.areEqual()) {
    return inputError("--skip-zero: is for what --masses names; equal masses are more than 0");
  }
  if (masses.normalize && masses.around() == Surface::free) {
    return inputError("--normalize: cells with a free surface do not fill the domain; --fill V scales them");
  }
  if (masses.surface == Surface::free && !masses.fill && masses.areEqual()) {
    return inputError("--surface: equal masses do not say how much there is; give --fill V or --masses FILE");
  }
  return {};
}

}  // namespace vorpipe::cli
