/// From the records of cells to the arrays of a Diagram.
#pragma once

#include "cells/tied_cells.h"
#include "sites/site_set.h"

namespace vorpipe::core {

/// Returns records for all input sites, filled in for duplicates, which have no cell of their own.
BigVector<CellRecord> makeRecords(const Prepared& prepared, const Sites& sites);

/// Resizes the arrays that `detail` requests, fills those that hold the content of the records, and counts
/// the statuses.
void takeRecords(std::span<const CellRecord> records, Detail detail, int threads, Diagram& diagram);

/// Writes neighbors, and for more detail than measures the vertices, edge lengths, perimeters
/// and second moments.
void writeEdges(const ProposedCells& proposed, const TiedCells& tied, Detail detail, const Unscale& unscale,
                Diagram& diagram);

/// Removes from a diagram what Detail::measures does not include.
void dropPolygons(Diagram& diagram);

/// Bounds for areaGap: the most from rounding alone; and a value far above that of any diagram whose cells
/// agree, so a larger gap means an error.
inline constexpr double area_rounding = 1e-12, area_wrong = 1e-6;

/// |sum of all areas - the domain's area| / the domain's area, with a compensated sum. 0 if the domain's area
/// is out of the range of double.
double areaGap(const Diagram& diagram, const Box& domain, int threads);
double areaGap(std::span<const CellRecord> records, const Box& domain, int threads);

}  // namespace vorpipe::core
