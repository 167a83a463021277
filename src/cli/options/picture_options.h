/// The options of pictures: their size, and what colors, edges and dots are.
#pragma once

#include <optional>

#include "cli/options/options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// What a --size names: a picture's sides, or the longer of them.
struct SizeChoice {
  std::optional<PictureSize> sides;
  int longer_side = 0;  ///< 0: there is none
};

/// `WxH` or `N`, 1 to largest_side each.
Parsed<SizeChoice> parseSizeChoice(std::string_view text);

/// What pictures that several subcommands draw have in common.
struct PictureOptions {
  RenderOptions render{};
  SizeChoice size;
  std::optional<Fit> fit;
  std::optional<double> edge_width;
  bool no_fill = false;
};

/// --size, --view, --fit
void addSizeOptions(Options& options, PictureOptions& picture);
/// --fit alone, for pictures that there are.
Option addFitOption(Options& options, std::optional<Fit>& fit);
/// --view alone.
Option addViewOption(Options& options, std::optional<Box>& view);
/// --color, --colormap, --color-scale, --color-range, --legend
void addColorOptions(Options& options, RenderOptions& picture);
/// --edges, --dual, --edge-width, --show-sites, --dot-size, --labels, --label-size, --no-fill, --antialias
void addMarkOptions(Options& options, PictureOptions& picture);
/// All of these, in a group of their own.
void addPictureGroup(Options& options, PictureOptions& picture);

/// The size that is known before the sites are; 1 x 1 where it is not.
PictureSize sizeBefore(const SizeChoice& size);

}  // namespace vorpipe::cli
