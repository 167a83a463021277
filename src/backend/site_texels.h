/// Sites and their grid as devices hold them; shaders/glsl/sites.glsl reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "backend/backend.h"

namespace vorpipe {

/// A site, from the center of the domain: each coordinate is the sum of what a float holds of it
/// and what a float holds of the rest, so that the difference of two sites loses next to nothing.
struct SiteTexel {
  float x_high, y_high, x_low, y_low;
};

/// Returns a point, seen from another, in the way of the sites of an upload with this domain.
SiteTexel siteTexel(const Box& domain, Point from, Point p);

/// What a picture needs to know about a site.
struct SiteMark {
  std::uint32_t id;             ///< what the id image gets
  std::uint32_t palette_index;  ///< index into a view's palette
};

/// The uniform block SiteGrid of site_grid.glsl, as std140 lays it out. Boxes are west, south, east, north.
struct SiteGridUniform {
  float domain_high[4], domain_low[4];  ///< from the center of the domain, like a site
  float coverage_high[4], coverage_low[4];
  SiteTexel corner;  ///< of the grid, at its lowest coordinates
  float size;        ///< of a bin
  float slack;  ///< by how much a site may lie outside of its bin, of the way to the grid's farthest corner
  std::int32_t columns, rows;
  std::int32_t most;  ///< sites that a search tries before it gives up
  std::int32_t heavy_count;
  std::int32_t padding[2];
  std::int32_t heavy[most_heavy];  ///< SiteSet::heavy
};

/// Returns the block for the sites of an upload.
SiteGridUniform siteGridUniform(const SiteSet& sites);

/// Writes a SiteTexel for every site, to mapped memory for instance, on all threads.
/// `to` has room for sites.size() of them.
void writeSiteTexels(const SiteSet& sites, std::byte* to);

/// Writes a SiteMark for every site likewise; palette_index has an element for each.
void writeSiteMarks(const SiteSet& sites, std::span<const std::uint8_t> palette_index, std::byte* to);

/// A weight: what a float holds of it, and what a float holds of the rest.
struct WeightTexel {
  float high, low;
};

/// Writes a WeightTexel for every site likewise. The set has weights.
void writeWeightTexels(const SiteSet& sites, std::byte* to);

/// How many bytes writeHeaviest() writes: a float for each of Grid::heaviest, in texels of four.
std::size_t heaviestBytes(const SiteSet& sites);

/// Writes Grid::heaviest, rounded up.
void writeHeaviest(const SiteSet& sites, std::byte* to);

}  // namespace vorpipe
