/// Cells of all sites of a run, proposed, checked, and where they are in dispute recomputed, until they are
/// proved.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "space/cell_check.h"
#include "space/rows.h"
#include "space/site_bins.h"
#include "vorpipe/result.h"

namespace vorpipe::space {

struct CertifiedRows {
  explicit CertifiedRows(std::size_t sites) : rows(sites), measures(sites) {}
  Rows rows;                                    ///< no faces: the site has no cell
  std::vector<CellMeasures> measures;           ///< by site; not of those in `careful`
  std::vector<std::array<double, 6>> moments;   ///< second moments, by site; likewise. Empty unless asked for
  std::vector<std::vector<double>> face_areas;  ///< by site, by face; likewise
  std::vector<std::uint32_t> tied;              ///< sites whose cells may have ties, ascending
  std::vector<std::uint32_t>
      careful;              ///< those of them whose vertices are too badly conditioned for measures
  std::uint64_t exact = 0;  ///< number of times that a cell was recomputed exactly
  std::vector<RowArena> arenas;
};

/// Condition C4: the number of cells that have the corner of xmin, ymin and zmin is 1.
std::size_t cellsOfCorner(const Rows& rows);

/// Condition C5: whether a site without a row was not computed exactly, or lies in the box, where each site
/// has a cell. `exact` is by site.
bool forgetsSite(const Places& places, const Rows& rows, std::span<const std::uint8_t> exact);

/// Errors: progress asked to stop (cancelled); cells that remain in dispute, which is a fault of vorpipe
/// (device).
Result<CertifiedRows> certify(const SiteBins& bins, bool moments, const Progress& progress, int threads);

}  // namespace vorpipe::space
