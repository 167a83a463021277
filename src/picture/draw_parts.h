/// The cells of a picture, drawn in as many views as a device needs, and with several samples in a pixel.
#pragma once

#include <cstdint>
#include <span>

#include "cells/exact_search.h"
#include "picture/kept_picture.h"
#include "sites/images.h"

namespace vorpipe::core {

/// The data that fills pixels without a site; all of it outlives this.
struct NearestSites {
  ExactSearch& exact_search;
  const SiteSet& sites;
  std::span<const std::uint8_t> palette_index;  ///< by index in the set
  std::uint64_t ids;                            ///< ids of sites are less than this
  int threads;
};

/// Fills every pixel of a view that a device left without a site or with an invalid id, for whatever reason.
/// The pixel gets its nearest site and that site's color; if no site has a cell, no site and color 0. Row 0
/// is the bottom. Returns the number of such pixels; if it is 0, nothing is written.
std::uint64_t coverRest(const NearestSites& nearest, const View& view, std::span<std::uint32_t> rgba,
                        std::span<std::uint32_t> ids);

/// Pixels that show a part of a box, counted from the left and from the bottom.
struct ShownPart {
  Box box{};               ///< everything that the frame shows
  int across = 0, up = 0;  ///< its pixels
  int left = 0, bottom = 0, width = 0, height = 0;

  /// Returns the box that some of the part's pixels show, relative to the box's lower left corner.
  [[nodiscard]] Box boxOf(int column, int row, int columns, int rows) const {
    const auto x = [&](int at) { return (box.xmax - box.xmin) * (left + at) / across; };
    const auto y = [&](int at) { return (box.ymax - box.ymin) * (bottom + at) / up; };
    return {x(column), y(row), x(column + columns), y(row + rows)};
  }
};

/// Returns the box that a picture shows, in the units of its scene.
Box shownIn(const Scene& scene, const RenderOptions& options);

/// Returns the pixels of a picture that show its domain. The sites are the scene's times 2^exponent.
ShownPart shownPart(const Scene& scene, const RenderOptions& options, int exponent);

/// The drawn picture and its figures.
struct Drawn {
  Image image;
  double download_seconds = 0;
  std::uint64_t uncovered = 0;  ///< pixels that the device did not cover
};

/// `room` is the number of pixels that the picture will have.
Result<Drawn> drawParts(Backend& backend, CellDrawing& drawing, const NearestSites& nearest,
                        const ShownPart& shown, const Palette& palette, std::size_t room);

/// Decides which cells are drawn, and whether by the device. Selecting cells pays if at least as many others
/// are left out.
WhatToDraw whatToDraw(const SiteSet& set, const RenderOptions& options, const ShownPart& shown);

/// Draws some rows of a picture's frame at a time.
class SampleDrawing {
 public:
  /// The sites must have their colors. All arguments must live as long as this object.
  SampleDrawing(const Machine& machine, const NearestSites& nearest, const RenderOptions& options,
                const Palette& palette, KeptPicture& kept);

  /// Returns the samples of the rows from `first` to before `last` of the frame, masked by the outline. Ids
  /// are those of the scene.
  Result<Image> draw(int first, int last);

 private:
  const Machine& machine_;
  const NearestSites& nearest_;
  int in_pixel_;
  RenderOptions options_;  ///< of the frame alone, with one sample per pixel
  const Palette& palette_;
  const KeptPicture& kept_;
  ShownPart all_;
  CellDrawing drawing_;
};

}  // namespace vorpipe::core
