/// The options of pictures: size, colors, edges and dots.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string_view>

#include "cli/options/options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// The value of --size: a picture's sides, or the longer of them.
struct SizeChoice {
  std::optional<PictureSize> sides;
  int longer_side = 0;  ///< 0: not given
  /// On paper, in millimeters, instead; `height` is 0 where only the longer side is given.
  std::optional<PaperSize> paper{};
};

/// `WxH` or `N`, 1 to largest_side each; or a length on paper with mm, cm or in, as `420x594mm`.
Parsed<SizeChoice> parseSizeChoice(std::string_view text);

/// The value of --color where a photograph gives the colors.
struct PhotographChoice {
  std::string file;        ///< empty: none
  std::optional<Box> box;  ///< where its pixels lie
};

/// Options of pictures that several subcommands share.
struct PictureOptions {
  RenderOptions render{};
  std::string color_attribute;  ///< of the sites, for ColorBy::value
  std::string label_attribute;  ///< of the sites; empty: labels are their indices
  std::string colors_file;      ///< with the colors of a map
  SizeChoice size;
  double dpi = 300;  ///< pixels per inch of a size on paper
  PhotographChoice photograph;
  std::optional<Fit> fit;
  std::set<std::string_view> given;  ///< names of given numbers of picture_rows
  bool no_fill = false;
};

/// --size, --view, --fit
void addSizeOptions(Options& options, PictureOptions& picture);
/// --fit alone, for existing pictures.
Option addFitOption(Options& options, std::optional<Fit>& fit);
/// --view alone.
Option addViewOption(Options& options, std::optional<Box>& view);
/// --color, --colormap, --color-scale, --color-range and --legend, of sites without attributes.
void addColorOptions(Options& options, RenderOptions& picture);
/// The same, and attributes, --color FILE with --color-box, --colormap FILE, --legend beside, --legend-title,
/// --title.
void addColorOptions(Options& options, PictureOptions& picture);
/// Whether attributes of the sites are needed.
inline bool needsAttributes(const PictureOptions& picture) {
  return !picture.color_attribute.empty() || !picture.label_attribute.empty();
}
/// What --labels writes. Sites that are edited or flow have no attributes.
enum class LabelsOf : std::uint8_t { attributes, indices };
/// The options of picture_rows, and --no-fill.
void addMarkOptions(Options& options, PictureOptions& picture, LabelsOf labels = LabelsOf::attributes);
/// Error (input): a number is given that draws nothing without a flag.
Result<void> checkMarks(const PictureOptions& picture);
/// --map, --view-from, --graticule
void addMapOptions(Options& options, PictureOptions& picture);
/// Error (input): an option is for the globe and there is none, or for a plane and there is the globe.
Result<void> checkMap(const PictureOptions& picture, bool globe);
/// All of these but those of maps, in a group of their own.
void addPictureGroup(Options& options, PictureOptions& picture);

/// Error (input): --dpi without a size on paper, or more pixels than a picture can have.
Result<void> checkPaper(const PictureOptions& picture);

/// Returns the size if it is known before the sites are read; else a lower bound of it.
PictureSize sizeBefore(const PictureOptions& picture);

/// Returns the size of a picture of `shown`.
PictureSize sizeOf(const PictureOptions& picture, const Box& shown);

}  // namespace vorpipe::cli
