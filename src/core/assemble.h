/// The arrays of a Diagram: made, and filled cell by cell.
#pragma once

#include "core/prepare.h"
#include "core/ties.h"

namespace vorpipe {

/// Gives the arrays that `detail` asks for their lengths, those by edge an upper bound, and writes
/// what is known of sites without a cell of their own: duplicates.
void makeArrays(const Prepared& prepared, const Sites& sites, const Neighborhoods& cells, Detail detail,
                int threads, Diagram& diagram);

/// Turns the numbers of edges in cell_offsets into offsets, counts the statuses, and cuts the arrays by
/// edge to their length.
void closeArrays(Diagram& diagram);

/// Writes neighbors, and for more detail than measures the vertices, edge lengths, perimeters
/// and second moments.
void writeEdges(const ProposedCells& proposed, const TiedCells& tied, Detail detail, const Records& records);

/// By how much the sum of all areas differs from the domain's area, as a part of that. Summation
/// itself loses nothing that counts. 0 if areas of the domain's size are beyond the range of doubles.
double areaGap(const Diagram& diagram, const Box& domain, int threads);

}  // namespace vorpipe
