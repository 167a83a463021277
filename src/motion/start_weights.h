/// Initial weights with which every cell has some of its mass.
#pragma once

#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// Maps the box of all sites to `into`, and returns weights for which each site's image lies in its cell. So
/// no cell is empty, wherever the sites are (Meyron 2019, section 3.3: the weights of a convex function's
/// gradient). Sites on one line, or all at one place, are only shifted across it, not scaled. Along a
/// periodic axis nothing is mapped, since cells already lie at their sites.
std::vector<double> spreadWeights(const Sites& sites, const Box& into, Periodic periodic);

/// Whether the box of all sites is about as large as the domain: then equal weights are a better start.
/// Periodic axes count as full.
bool fillDomain(const Sites& sites, const Box& domain, Periodic periodic);

/// Subtracts the mean from all weights. This changes no cells, except those of a free surface. Newton steps
/// have the mean 0. Centering the weights after them would round the smallest weights off, after they were
/// measured.
void centerWeights(std::vector<double>& weights, int threads);

/// Returns the weights of discs with these masses as areas, right where no two discs meet.
std::vector<double> discWeights(std::span<const double> masses);

/// Returns about the largest box with the domain's proportions that lies in the outline and has a density
/// above 0. It is found from samples in 128 rows and columns. Returns the domain itself if there is none.
Box boxWithMass(const CellsOptions& options);

}  // namespace vorpipe::moving
