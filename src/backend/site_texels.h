/// Sites and their grid as devices hold them; shaders/glsl/sites.glsl reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/backend.h"

namespace vorpipe {

/// A site relative to the center of the domain. Each coordinate is the sum of two floats, the second with the
/// remainder, so that the difference of two sites loses almost nothing.
struct SiteTexel {
  float x_high, y_high, x_low, y_low;
};

/// Returns point `p`, given relative to `from`, in the format of uploaded sites with this domain.
SiteTexel siteTexel(const Box& domain, Point from, Point p);

/// What a picture needs from a site.
struct SiteMark {
  std::uint32_t id;             ///< value written to the id image
  std::uint32_t palette_index;  ///< index into a view's palette
};

/// The uniform block SiteGrid of site_grid.glsl, as std140 lays it out. Boxes are west, south, east, north.
struct SiteGridUniform {
  float domain_high[4], domain_low[4];  ///< from the center of the domain, like a site
  float coverage_high[4], coverage_low[4];
  SiteTexel corner;  ///< of the grid, at its lowest coordinates
  float size;        ///< of a bin
  float slack;  ///< how far a site may lie outside its bin, relative to the distance of the grid's farthest
                ///< corner
  std::int32_t columns, rows;
  std::int32_t most;  ///< number of sites that a search tries before it gives up
  std::int32_t heavy_count;
  std::int32_t padding[2];
  std::int32_t heavy[most_heavy];  ///< SiteSet::heavy
};

/// Returns the block for the sites of an upload.
SiteGridUniform siteGridUniform(const SiteSet& sites);

/// Writes a SiteTexel for every site, on all threads. `to` has room for sites.size() of them and may be
/// mapped memory.
void writeSiteTexels(const SiteSet& sites, std::byte* to);

/// Writes a SiteMark for every site in the same way; palette_index has one element per site.
void writeSiteMarks(const SiteSet& sites, std::span<const std::uint8_t> palette_index, std::byte* to);

/// A weight as the sum of two floats, the second with the remainder.
struct WeightTexel {
  float high, low;
};

/// Writes a WeightTexel for every site in the same way. The set must have weights.
void writeWeightTexels(const SiteSet& sites, std::byte* to);

/// Returns the number of bytes that writeHeaviest() writes: one float per element of Grid::heaviest, padded
/// to texels of four.
std::size_t heaviestBytes(const SiteSet& sites);

/// Writes Grid::heaviest in float, each value rounded up.
void writeHeaviest(const SiteSet& sites, std::byte* to);

}  // namespace vorpipe
