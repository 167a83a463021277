/// From the records of cells to the arrays of a Diagram.
#pragma once

#include "core/sites/site_set.h"
#include "core/ties/ties.h"

namespace vorpipe::core {

/// Records for all input sites; those of sites without a cell of their own, duplicates, are written.
BigVector<CellRecord> makeRecords(const Prepared& prepared, const Sites& sites);

/// Gives the arrays that `detail` asks for their lengths, fills those that say what the records do, and
/// counts the statuses.
void takeRecords(std::span<const CellRecord> records, Detail detail, int threads, Diagram& diagram);

/// Writes neighbors, and for more detail than measures the vertices, edge lengths, perimeters
/// and second moments.
void writeEdges(const ProposedCells& proposed, const TiedCells& tied, Detail detail, const Unscale& unscale,
                Diagram& diagram);

/// Leaves of a diagram what Detail::measures has.
void dropPolygons(Diagram& diagram);

/// Of the domain's area, what the areas may miss or exceed it by: what double leaves, and what no diagram of
/// cells that agree has ever come near.
inline constexpr double area_rounding = 1e-12, area_wrong = 1e-6;

/// By how much the sum of all areas differs from the domain's area, as a part of that. Summation
/// itself loses nothing that counts. 0 if areas of the domain's size are beyond the range of doubles.
double areaGap(const Diagram& diagram, const Box& domain, int threads);
double areaGap(std::span<const CellRecord> records, const Box& domain, int threads);

}  // namespace vorpipe::core
