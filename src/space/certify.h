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
std::size_t cellsOfCorner(const Rows& rows, int threads = 1);

/// Condition C5: whether a site without a row is not proved to have no cell. `hidden` is by site: whether
/// leaveNothing() has said so.
bool forgetsSite(const Rows& rows, std::span<const std::uint8_t> hidden, int threads = 1);

/// Two sites, by their numbers in the input and their places there, that are nearer to each other than cells
/// are computed of.
Error nearSites(std::uint32_t a, const Point3& at_a, std::uint32_t b, const Point3& at_b);

/// Writes the records of all cells but of those whose vertices are too badly conditioned for quick measures.
/// Errors: sites that are too near to each other (input); progress asked to stop (cancelled); cells that
/// remain in dispute, which is a fault of vorpipe (device).
Result<CertifiedRows> certify(const SiteBins& bins, Records& records, const Progress& progress, int threads);

}  // namespace vorpipe::space
