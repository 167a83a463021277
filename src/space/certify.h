/// Cells of all sites of a run, proposed, checked, and where they are in dispute recomputed, until they are
/// proved.
#pragma once

#include <cstdint>
#include <vector>

#include "space/records.h"
#include "space/rows.h"
#include "space/site_bins.h"
#include "vorpipe/result.h"

namespace vorpipe::space {

struct CertifiedRows {
  explicit CertifiedRows(const SiteBins& bins) : rows(bins.sites.size(), bins.input) {}
  Rows rows;                              ///< no faces: the site has no cell
  std::vector<std::uint32_t> tied;        ///< sites whose cells may have ties, ascending
  std::vector<std::uint32_t> unmeasured;  ///< those whose cells have no records yet, ascending
  std::uint64_t exact = 0;                ///< number of times that a cell was recomputed exactly
};

/// Condition C4: the number of cells that have the corner of xmin, ymin and zmin is 1.
std::size_t cellsOfCorner(const Rows& rows);

/// Condition C5: whether a site without a row was not computed exactly, or lies in the box, where each site
/// has a cell. `exact` is by site.
bool forgetsSite(const Places& places, const Rows& rows, std::span<const std::uint8_t> exact);

/// Writes the records of all cells but of those whose vertices are too badly conditioned for quick measures.
/// Errors: progress asked to stop (cancelled); cells that remain in dispute, which is a fault of vorpipe
/// (device).
Result<CertifiedRows> certify(const SiteBins& bins, Records& records, const Progress& progress, int threads);

}  // namespace vorpipe::space
